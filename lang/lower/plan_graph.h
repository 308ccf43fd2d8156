// The expressions of a plan and what is known of each (internal to lowering).
//
// Where a node is computed, and how often, is decided later (lang/lower/pass_planner.h).
#pragma once

#include "lang/lower/graph_passes.h"

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>

namespace cascade::lowering {

/// What stands beyond the two sides of an axis where a value is read at neighbours.
enum class Beyond : std::uint8_t {
    anything,  ///< The value is the same everywhere, or the axis has one cell.
    periodic,  ///< What it is in the opposite cells.
    mirrored,  ///< What it is in the cells at the sides.
    itself,    ///< Of a species what its sides say; of a function of such what it makes of them.
};

/// What counts as step-invariant: what no step changes, or all but t and step.
enum class Invariance : std::uint8_t { parameters, state };

class PlanGraph {
public:
    PlanGraph(Expressions expressions, const PassContext& context,
              Invariance step_invariants = Invariance::parameters);

    const Node& operator[](NodeId id) const { return expressions_.graph[id]; }
    auto ids() const { return facts_.ids(); }
    auto ids_backwards() const { return facts_.ids_backwards(); }
    std::size_t size() const { return facts_.size(); }
    /// The values that were asked for, in their order.
    const std::vector<NodeId>& roots() const { return expressions_.roots; }

    /// Is it the same in all cells?
    bool is_uniform(NodeId id) const { return facts_[id].is_uniform; }
    /// Is it the same in all steps of the stage?
    bool is_step_invariant(NodeId id) const { return facts_[id].is_step_invariant; }
    /// Is it beyond some side neither what it is in the opposite cell nor what it is in the cell
    /// at the side? Then its plane has no halo, and it is computed there.
    bool is_open(NodeId id) const;
    /// How the halo of its plane is filled. Of one that is not open.
    Boundaries boundary(NodeId id) const;
    /// Species, parameters that vary, files and the metric lie in planes from the start.
    bool is_plane(NodeId id) const;
    /// The definition or rate that it is the value of, as a user calls it; "" for others.
    const std::string& name(NodeId id) const;
    /// Where it was written, and where in it; null for what a pass has made.
    const Origin* origin(NodeId id) const;
    NodeId position(NodeId id) const { return expressions_.graph.written(id).position; }

    const Program& program() const { return context_.program; }
    std::uint32_t stage() const { return context_.stage; }
    bool has_mask() const { return context_.has_mask(); }
    /// Do cells read neighbours over links? Then operators read planes alone, and `lap` of two
    /// operands is div(first * grad(second)).
    bool is_linked() const { return context_.has_model(); }

private:
    struct Facts {
        bool is_uniform = false, is_step_invariant = false;
        std::array<Beyond, 3> beyond{};  ///< By axis.
    };
    bool is_step_invariant(const Node& node, Invariance what) const;
    std::array<Beyond, 3> beyond(const Node& node, bool is_uniform) const;

    Expressions expressions_;
    PassContext context_;
    IdVector<NodeId, Facts> facts_;
    std::unordered_map<NodeId, std::string> names_;
};

}  // namespace cascade::lowering
