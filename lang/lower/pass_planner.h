// Decides which nodes of formulas are computed in which pass (internal to lowering).
#pragma once

#include "lang/lower/plan_graph.h"
#include "lang/lower/step_plan.h"
#include "lang/program/stencils.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cascade::lowering {

/// The cells that may replace cells at these offsets if those are outside of the domain
/// (lower_mask.cpp): the cell itself and, for a diagonal neighbour, the two cells in between.
Offsets stand_ins(Offsets offsets);

/// A face between two cells and a component of a vector there. The face lies between cell `cell()`
/// and the next one along `axis`; `side` 0 is the face after the cell itself, 1 the one before it.
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

/// The approximate number of kernel operations of a node, given its operands.
int operations_of(const Node& node);

/// The number of operations on a cell that take a core as long as writing a plane and reading it
/// back (about twelve bytes a cell).
inline constexpr int operations_of_writing = 40;
/// Reading a plane alone is a third of that traffic.
inline constexpr int operations_of_reading = operations_of_writing / 3;

/// The decisions about the nodes of a graph.
class PassPlanner {
public:
    /// `roots` are needed in the cell itself, in the last pass. The nodes `step_invariants` are
    /// known before the first pass; those that vary are in planes.
    PassPlanner(const PlanGraph& graph, std::span<const NodeId> roots, Materialise materialise,
                std::span<const NodeId> step_invariants = {});

    std::uint32_t pass_count() const { return pass_count_; }
    bool is_needed(NodeId node) const { return needed_[node]; }
    /// Is it known before the first pass?
    bool is_step_invariant(NodeId node) const { return step_invariant_[node]; }
    /// Is the node written to a temporary plane?
    bool is_written(NodeId node) const { return written_[node]; }
    /// The first pass in which it can be computed in the cell itself; a node that is written is
    /// computed then, and a nonlocal one directly before.
    std::uint32_t pass_of(NodeId node) const { return pass_[node]; }
    /// Is it read from a plane in `pass`? A pass writes planes for later ones; what is computed on
    /// whole planes is there when its pass begins.
    bool is_plane_in(NodeId node, std::uint32_t pass) const {
        return written_[node] && first_reader(node) <= pass;
    }
    /// How an operand is provided at the neighbours where its reader needs it.
    struct OperandChoice {
        NodeId operand, reader;
        std::uint32_t places = 0;  ///< The largest number of neighbours at which it is needed.
        bool is_written = false;   ///< To a plane; otherwise it is recomputed at the neighbours.
        bool is_forced = false;    ///< It cannot be recomputed.
        bool is_open = false;      ///< It must be recomputed: see PlanGraph::is_open.
    };
    /// All operands that vary and are not planes, in order of their readers.
    const std::vector<OperandChoice>& choices() const { return choices_; }
    const GridAxes& axes() const { return axes_; }
    /// The offsets at which an operand is needed if its value is read at `offsets`.
    Offsets reach(Offsets offsets) const {
        return graph_.has_mask() ? offsets | stand_ins(offsets) : offsets;
    }

private:
    void mark_needed(std::span<const NodeId> roots);
    void decide(NodeId id);
    void decide_own(NodeId id);
    std::uint32_t pass_beside(NodeId operand) const;
    /// The first pass that can read the plane of a node that is written.
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
    IdVector<NodeId, bool> stays_;  ///< By node: it cannot be computed for a neighbour.
    IdVector<NodeId, std::uint32_t>
        pass_;  ///< By node: the first pass in which its value in the cell itself is known …
    IdVector<NodeId, std::uint32_t> beside_;  ///< … and its values at neighbours, read from planes.
    std::vector<OperandChoice> choices_;
};

}  // namespace cascade::lowering
