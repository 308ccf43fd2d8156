// Lowers a pass: finds in which cells each node is needed, and emits the instructions (internal to
// lowering).
//
// pass_needs.cpp goes backwards through the nodes and finds the cells (for vectors, the faces) in
// which each node is needed. lower_pass.cpp goes forwards and computes each node once in each of
// these cells or at each of these faces.
#pragma once

#include "lang/lower/crossings.h"
#include "lang/lower/lower_node.h"
#include "lang/lower/pass_planner.h"

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade::lowering {

/// Where the result of each node is stored.
struct Storage {
    /// For each node that a pass writes to a plane, the plane.
    IdVector<NodeId, TemporaryId> temporary;
    IdVector<NodeId, AggregateId> aggregate;  ///< For aggregates.
    /// For each node that is known before all passes, its index.
    IdVector<NodeId, StepInvariantId> step_invariant;
};

/// The planner's decisions, from the point of view of one pass.
struct PassView {
    const PlanGraph& graph;
    const PassPlanner& planner;
    const Storage& storage;
    std::uint32_t pass = 0;

    /// Whether the node can be read, at the offsets `where`, from a plane that an earlier pass has
    /// written. Planes of open nodes (PlanGraph::is_open) have no halo, so they can be read only in
    /// the cell itself.
    bool is_plane_at(NodeId id, Offsets where) const {
        return planner.is_plane_in(id, pass) && (where == own_cell || !graph.is_open(id));
    }
    /// Whether the node is read and not computed. It is read from its plane or, if it is an
    /// aggregate, as a number.
    bool is_source(NodeId id, Offsets where) const {
        return is_aggregate(graph[id]) || planner.is_step_invariant(id) || is_plane_at(id, where);
    }
    /// Whether the node is in a plane that the operation `laplacian` can read directly.
    bool can_read_as_plane(NodeId id) const {
        return !graph.is_uniform(id) && (planner.is_step_invariant(id) || graph.is_plane(id) ||
                                         (planner.is_plane_in(id, pass) && !graph.is_open(id)));
    }
    /// The plane from which a node is read. Must be called only if number() is nullopt.
    PlaneSource plane(NodeId id) const;
    std::optional<UniformSource> number(NodeId id) const;
};

using Needs = IdVector<NodeId, std::uint32_t>;
/// For each node, where it must be computed so that the nodes `wanted` can be computed in the cell
/// itself: a set of offsets (Offsets) or, for a vector, a set of faces (by number).
Needs needs_of(const PassView& pass, std::span<const NodeId> wanted);

/// The values that a pass computes in and around a cell.
class NodeValues {
public:
    NodeValues(const PlanGraph& graph, KernelAssembly& assembly, Needs needs);

    std::uint32_t needs(NodeId id) const { return needs_[id]; }
    /// The stored value of a node. `where` is the number of an offset or of a face.
    Value& slot(NodeId id, std::uint32_t where) { return values_[place(id, where)]; }
    const Value& at(NodeId id, Offset offset) const {
        return values_[place(id, graph_.is_uniform(id) ? Offset{}.number() : offset.number())];
    }
    ValueId number_at(NodeId id, Offset offset) const { return at(id, offset)[0]; }
    ValueId face(NodeId id, Face face) const { return values_[place(id, face.number())][0]; }

    // The value of a node at an offset. If the cell at the offset is outside the domain, values of
    // other cells replace it (lower_mask.cpp).
    ValueId beside(NodeId id, Offset offset) const;
    /// The value one step along an axis from the cell at `from`.
    ValueId beside(NodeId id, Offset from, Offset step) const;
    ValueId chosen(Offset inside, ValueId value, ValueId otherwise) const;

    /// The weighted sum in a difference (lang/program/stencils.h), before the division. nullopt if
    /// `taps` has no terms. Values with the same weight are added before the multiplication.
    /// `keeps_product` excludes the last product from contraction.
    std::optional<ValueId> weighted(NodeId id, const Taps& taps, bool keeps_product = false,
                                    Offset from = {}) const;
    /// The value times `factor`. Emits no instruction if `factor` is 1.
    ValueId scaled(ValueId value, double factor) const;

private:
    std::size_t place(NodeId id, std::uint32_t where) const;

    const PlanGraph& graph_;
    KernelAssembly& assembly_;
    KernelBuilder& builder_;
    Needs needs_;
    IdVector<NodeId, std::uint32_t> first_;  ///< The index of each node's first value in `values_`.
    std::vector<Value> values_;
};

/// The value of an operator in the present cell (lower_operators.cpp).
ValueId lower_stencil(const PassView& pass, KernelAssembly& assembly, const NodeValues& values,
                      NodeId id);

/// Lowers vectors at faces, and their divergence (lower_vectors.cpp).
class Fluxes {
public:
    Fluxes(const PassView& pass, KernelAssembly& assembly, const NodeValues& values);

    ValueId at_face(NodeId vector, Face face) const;
    ValueId divergence(const Node& node);

private:
    ValueId difference(NodeId id, Difference kind, Face face) const;
    ValueId average(NodeId id, Face face) const;
    struct AtFace;
    ValueId gradient(NodeId operand, Face face) const;
    ValueId through_sides(NodeId flux, Face face, ValueId value);

    const PlanGraph& graph_;
    const GridAxes& axes_;
    KernelBuilder& builder_;
    const NodeValues& values_;
    const Grid& grid_;
    /// The facts about each node. Empty until they are needed.
    IdVector<NodeId, Crossing> crossings_;
};

class PassLowering {
public:
    /// Computes the nodes `wanted` in the present cell, and all nodes that they need.
    PassLowering(const PassView& pass, KernelAssembly& assembly, std::span<const NodeId> wanted);

    /// The value of a wanted node in the present cell.
    const Value& value(NodeId id) const { return values_.at(id, Offset{}); }

private:
    void compute(NodeId id);
    Value compute_at(NodeId id, Offset offset);

    PassView pass_;
    KernelAssembly& assembly_;
    KernelBuilder& builder_;
    NodeValues values_;
    Fluxes fluxes_;
};

/// Calls visit(offset) for every offset of a set.
template <typename Visit>
void for_each_offset(Offsets offsets, const Visit& visit) {
    for (; offsets != 0; offsets &= offsets - 1) {
        visit(Offset::of(static_cast<std::uint32_t>(std::countr_zero(offsets))));
    }
}

template <typename Visit>
void for_each_face(std::uint32_t faces, const Visit& visit) {
    for (; faces != 0; faces &= faces - 1) {
        visit(Face::of(static_cast<std::uint32_t>(std::countr_zero(faces))));
    }
}

}  // namespace cascade::lowering
