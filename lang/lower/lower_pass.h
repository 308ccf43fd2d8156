// Lowers one pass: finds the nodes that it needs, and where, and emits their instructions (internal
// to lowering).
//
// Going backwards through the nodes, it finds the cells or, for vectors, the faces at which each is
// needed (pass_needs.cpp). Going forwards, each is computed there once (lower_pass.cpp).
#pragma once

#include "lang/lower/lower_node.h"
#include "lang/lower/pass_planner.h"

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade::lowering {

/// The numbers given to nodes, by node.
struct Storage {
    IdVector<NodeId, TemporaryId> temporary;           ///< If it is written.
    IdVector<NodeId, AggregateId> aggregate;           ///< If it is an aggregate.
    IdVector<NodeId, StepInvariantId> step_invariant;  ///< If it is known before the first pass.
};

/// The decisions of the planner, for one pass.
struct PassView {
    const PlanGraph& graph;
    const PassPlanner& planner;
    const Storage& storage;
    std::uint32_t pass = 0;

    /// Has an earlier pass written it? Planes of open nodes have no halo.
    bool is_plane_at(NodeId id, Offsets where) const {
        return planner.is_plane_in(id, pass) && (where == own_cell || !graph.is_open(id));
    }
    /// Is it read from its plane or, for an aggregate, from its number?
    bool is_source(NodeId id, Offsets where) const {
        return is_aggregate(graph[id]) || planner.is_step_invariant(id) || is_plane_at(id, where);
    }
    /// Is it a plane that the operation `laplacian` can read directly?
    bool can_read_as_plane(NodeId id) const {
        return !graph.is_uniform(id) && (planner.is_step_invariant(id) || graph.is_plane(id) ||
                                         (planner.is_plane_in(id, pass) && !graph.is_open(id)));
    }
    /// The source of a node that is a source, or a plane from the start: a plane, if not a number.
    PlaneSource plane(NodeId id) const;
    std::optional<UniformSource> number(NodeId id) const;
};

using Needs = IdVector<NodeId, std::uint32_t>;
/// The offsets (Offsets) or, for vectors, the faces (by number) at which each node must be computed
/// to get `wanted` in the cell itself.
Needs needs_of(const PassView& pass, std::span<const NodeId> wanted);

/// The values that a pass computes, and access to them around a cell.
class NodeValues {
public:
    NodeValues(const PlanGraph& graph, KernelAssembly& assembly, Needs needs);

    std::uint32_t needs(NodeId id) const { return needs_[id]; }
    /// By the number of the offset or face.
    Value& slot(NodeId id, std::uint32_t where) { return values_[place(id, where)]; }
    const Value& at(NodeId id, Offset offset) const {
        return values_[place(id, graph_.is_uniform(id) ? Offset{}.number() : offset.number())];
    }
    ValueId number_at(NodeId id, Offset offset) const { return at(id, offset)[0]; }
    ValueId face(NodeId id, Face face) const { return values_[place(id, face.number())][0]; }

    // If not all cells of the grid belong to the domain, other cells replace those outside
    // (lower_mask.cpp).
    /// The value at an offset from the cell itself.
    ValueId beside(NodeId id, Offset offset) const;
    /// The value in the cell one step along an axis from the cell at `from`.
    ValueId beside(NodeId id, Offset from, Offset step) const;
    ValueId chosen(Offset inside, ValueId value, ValueId otherwise) const;

    /// The sum of a row of the table of differences, not divided; nothing if it has no taps. Cells
    /// of a weight are added first. The last product may be kept from contraction.
    std::optional<ValueId> weighted(NodeId id, const Taps& taps, bool keeps_product = false,
                                    Offset from = {}) const;
    /// Multiplies unless the factor is 1.
    ValueId scaled(ValueId value, double factor) const;

private:
    std::size_t place(NodeId id, std::uint32_t where) const;

    const PlanGraph& graph_;
    KernelAssembly& assembly_;
    KernelBuilder& builder_;
    Needs needs_;
    IdVector<NodeId, std::uint32_t> first_;  ///< By node: the number of its first value.
    std::vector<Value> values_;
};

/// Lowers operators: the value in the cell itself (lower_operators.cpp).
ValueId lower_stencil(const PassView& pass, KernelAssembly& assembly, const NodeValues& values,
                      NodeId id);

/// The number of rows of a tensor whose operands are its entries.
int tensor_size(const Node& tensor);

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
    /// Whether a flux passes the sides of the grid.
    struct Crossing {
        bool goes_across = false;  ///< It may not be 0 even if everything is mirrored.
        bool has_species = false;
        std::array<bool, wall_count> is_open{};  ///< A species in it is not mirrored at this side.
    };
    void find_what_crosses_sides();

    const PlanGraph& graph_;
    const GridAxes& axes_;
    KernelBuilder& builder_;
    const NodeValues& values_;
    const Grid& grid_;
    IdVector<NodeId, Crossing> crossings_;  ///< By node; empty until computed.
};

class PassLowering {
public:
    /// Computes these nodes in the cell itself, and everything that they need.
    PassLowering(const PassView& pass, KernelAssembly& assembly, std::span<const NodeId> wanted);

    /// The value, in the cell itself, of a node that was wanted.
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
