// Decides in which pass each node of a formula is computed (internal to lowering).
#pragma once

#include "lang/lower/plan_graph.h"
#include "lang/lower/step_plan.h"
#include "lang/program/stencils.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cascade::lowering {

/// The cells whose values may be read in place of the cells at `offsets`, if the latter are outside
/// the domain (lower_mask.cpp): the present cell and, for a diagonal neighbour, also the two cells
/// between.
Offsets stand_ins(Offsets offsets);

/// A face between two cells, and a component of a vector at this face. Along `axis`, the face is
/// between cell `cell()` and cell `next()`. If `side` is 0, the face comes after the present cell,
/// and if `side` is 1, before it.
struct Face {
    int axis = 0;
    int component = 0;
    int side = 0;

    static constexpr std::uint32_t count = 18;
    static constexpr Face of(std::uint32_t number) {
        const int n = static_cast<int>(number);
        return {n / 6, n / 2 % 3, n % 2};
    }
    constexpr std::uint32_t number() const {
        return static_cast<std::uint32_t>((axis * 3 + component) * 2 + side);
    }
    constexpr Offset cell() const { return Offset::along(axis, -side); }
    constexpr Offset next() const { return Offset::along(axis, 1 - side); }
};

/// The approximate number of kernel operations that compute a node from its operands.
int operations_of(const Node& node);

/// Writing a plane and reading it again takes a core as long as this number of operations per cell.
/// It moves about twelve bytes per cell.
inline constexpr int operations_of_writing = 40;
/// Reading a plane takes a core as long as this number of operations per cell. It moves a third of
/// the bytes.
inline constexpr int operations_of_reading = operations_of_writing / 3;

/// The decisions about all nodes of a graph.
class PassPlanner {
public:
    /// `roots` are needed in the cell itself, in the last pass. The nodes `step_invariants` are
    /// known before the first pass. Step-invariants that vary by cell are in planes.
    PassPlanner(const PlanGraph& graph, std::span<const NodeId> roots, Materialise materialise,
                std::span<const NodeId> step_invariants = {});

    std::uint32_t pass_count() const { return pass_count_; }
    bool is_needed(NodeId node) const { return needed_[node]; }
    /// Whether the node is known before the first pass.
    bool is_step_invariant(NodeId node) const { return step_invariant_[node]; }
    /// Whether the node is written to a temporary plane.
    bool is_written(NodeId node) const { return written_[node]; }
    /// The first pass that can compute the node in the cell itself. A written node is computed in
    /// this pass, and a nonlocal node directly before this pass.
    std::uint32_t pass_of(NodeId node) const { return pass_[node]; }
    /// Whether the node can be read from a plane in `pass`. A plane that a pass writes can be read
    /// only in later passes. The plane of a nonlocal node is computed directly before a pass, and
    /// can be read in that pass.
    bool is_plane_in(NodeId node, std::uint32_t pass) const {
        return written_[node] && first_reader(node) <= pass;
    }
    /// How an operand is provided at the neighbours at which its reader needs it.
    struct OperandChoice {
        NodeId operand, reader;
        /// The largest number of neighbours at which the operand is needed.
        std::uint32_t places = 0;
        /// Whether the operand is read from a plane. If not, it is recomputed at the neighbours.
        bool is_written = false;
        /// Whether the operand must be read from a plane, because it cannot be recomputed.
        bool is_forced = false;
        bool is_open = false;  ///< Whether the operand must be recomputed (PlanGraph::is_open).
    };
    /// The choices for all operands that vary and are not in planes from the start, in the order of
    /// their readers.
    const std::vector<OperandChoice>& choices() const { return choices_; }
    const GridAxes& axes() const { return axes_; }
    /// The offsets at which an operand must be available if a node reads it at `offsets`.
    Offsets reach(Offsets offsets) const {
        return graph_.has_mask() ? offsets | stand_ins(offsets) : offsets;
    }

private:
    void mark_needed(std::span<const NodeId> roots);
    void decide(NodeId id);
    void decide_own(NodeId id);
    std::uint32_t pass_beside(NodeId operand) const;
    /// The first pass that can read the plane of a written node.
    std::uint32_t first_reader(NodeId node) const {
        return is_nonlocal(graph_[node]) ? pass_[node] : pass_[node] + 1;
    }
    void write_whole(NodeId operand, NodeId reader);
    void provide(NodeId operand, Offsets offsets, NodeId reader);
    void provide_over_links(NodeId operand, NodeId reader);
    void provide_open(NodeId operand, Offsets offsets, NodeId reader);
    template <typename Visit>
    void for_each_closed(NodeId open, const Visit& visit) const;
    bool is_plane(NodeId id) const { return step_invariant_[id] || graph_.is_plane(id); }
    bool is_expensive(NodeId id, std::uint32_t places) const;

    const PlanGraph& graph_;
    GridAxes axes_;
    Materialise materialise_;
    std::uint32_t pass_count_ = 1;
    IdVector<NodeId, bool> needed_, written_, step_invariant_;
    IdVector<NodeId, bool> stays_;  ///< For each node, whether it cannot be computed at neighbours.
    /// For each node, the first pass in which its value in the cell itself is known.
    IdVector<NodeId, std::uint32_t> pass_;
    /// For each node, the first pass in which its values at neighbours can be read from planes.
    IdVector<NodeId, std::uint32_t> beside_;
    std::vector<OperandChoice> choices_;
};

}  // namespace cascade::lowering
