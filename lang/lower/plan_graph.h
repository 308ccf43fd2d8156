// The expressions of a plan, with facts about each (internal to lowering).
//
// Where and how often a node is computed is decided later (lang/lower/pass_planner.h).
#pragma once

#include "lang/lower/graph_passes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

namespace cascade::lowering {

/// The value beyond the two sides of an axis, for nodes that are read at neighbours.
enum class Beyond : std::uint8_t {
    anything,  ///< The value is the same everywhere, or the axis has one cell.
    periodic,  ///< The value in the opposite cell.
    mirrored,  ///< The value in the cell at the side.
    itself,    ///< For a species, as its sides say; for a function, computed from such operands.
};

using SideKinds = std::array<SideKind, side_count>;

/// The kinds of the sides of an item. A species may have sides of its own; all other items have
/// those of the domain.
SideKinds side_kinds(const Program& program, std::uint32_t stage, ItemId item);

/// What random numbers are: drawn anew in every step, or once for a side when a stage starts.
enum class Draws : std::uint8_t { every_step, once };

class PlanGraph {
public:
    PlanGraph(Expressions expressions, const PassContext& context, Draws draws = Draws::every_step);

    const Node& operator[](NodeId id) const { return expressions_.graph[id]; }
    auto ids() const { return facts_.ids(); }
    auto ids_backwards() const { return facts_.ids_backwards(); }
    std::size_t size() const { return facts_.size(); }
    /// The requested values, in their order.
    const std::vector<NodeId>& roots() const { return expressions_.roots; }

    /// Does it have the same value in all cells?
    bool is_uniform(NodeId id) const { return facts_[id].is_uniform; }
    /// Does it have the same value in all steps of the stage?
    bool is_step_invariant(NodeId id) const { return facts_[id].is_step_invariant; }
    /// Is its value beyond some side neither that of the opposite cell nor that of the cell at the
    /// side? Its plane then has no halo, and it is recomputed there.
    bool is_open(NodeId id) const;
    /// How the halo of its plane is filled; not for open nodes.
    Boundaries boundary(NodeId id) const;
    /// Species, parameters that vary, files and the metric are in planes from the start.
    bool is_plane(NodeId id) const;
    /// The name of the definition or rate whose value it is; "" for others.
    const std::string& name(NodeId id) const;
    /// The sides of the definition whose value it is, and their number in Stage::definition_sides;
    /// nothing for others.
    const DefinitionSides* sides(NodeId id) const;
    std::optional<std::size_t> wall(NodeId id) const;
    /// Where it was written; null for nodes made by a pass.
    const Origin* origin(NodeId id) const;
    NodeId position(NodeId id) const { return expressions_.graph.written(id).position; }

    const Expressions& expressions() const { return expressions_; }
    const Program& program() const { return context_.program; }
    std::uint32_t stage() const { return context_.stage; }
    bool has_mask() const { return context_.has_mask(); }
    /// Do cells read neighbours over links? Operators then read only planes, and `lap` of two
    /// operands is div(first * grad(second)).
    bool is_linked() const { return context_.has_links(); }
    const PassContext& context() const { return context_; }
    const Grid& grid() const { return context_.grid(); }

private:
    struct Facts {
        bool is_uniform = false, is_step_invariant = false;
        std::array<Beyond, 3> beyond{};  ///< By axis.
    };
    bool is_step_invariant(const Node& node, bool is_uniform, Draws draws) const;
    std::array<Beyond, 3> beyond(NodeId id, bool is_uniform) const;

    Expressions expressions_;
    PassContext context_;
    IdVector<NodeId, Facts> facts_;
    std::unordered_map<NodeId, std::string> names_;
    std::unordered_map<NodeId, std::size_t> walls_;
};

}  // namespace cascade::lowering
