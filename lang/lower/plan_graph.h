// The expression graph of a plan, with facts about each node (internal to lowering).
//
// After the graph has been made, lang/lower/pass_planner.h decides where and how often each node is
// computed.
#pragma once

#include "lang/lower/graph_passes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

namespace cascade::lowering {

/// Which value operators read for a node at a neighbour that lies beyond the sides of an axis.
enum class Beyond : std::uint8_t {
    /// Any value will do, because all cells have the same value, or because the axis has one cell.
    anything,
    periodic,  ///< The value in the opposite cell of the axis.
    mirrored,  ///< The value in the cell beside the side.
    itself,    ///< Another value. A species' rule gives it, or it is computed from operands.
};

using SideKinds = std::array<SideKind, side_count>;

/// The kinds of rules at the sides of an item. A species may have its own rules. All other items
/// have the rules of the domain.
SideKinds side_kinds(const Program& program, std::uint32_t stage, ItemId item);

/// When random numbers are drawn: in every step, or once when a stage starts, as for a value at a
/// side.
enum class Draws : std::uint8_t { every_step, once };

class PlanGraph {
public:
    PlanGraph(Expressions expressions, const PassContext& context, Draws draws = Draws::every_step);

    const Node& operator[](NodeId id) const { return expressions_.graph[id]; }
    auto ids() const { return facts_.ids(); }
    auto ids_backwards() const { return facts_.ids_backwards(); }
    std::size_t size() const { return facts_.size(); }
    /// The requested values, in the order in which they were requested.
    const std::vector<NodeId>& roots() const { return expressions_.roots; }

    /// Whether the node has the same value in all cells.
    bool is_uniform(NodeId id) const { return facts_[id].is_uniform; }
    /// Whether the node has the same value in all steps of the stage.
    bool is_step_invariant(NodeId id) const { return facts_[id].is_step_invariant; }
    /// Whether the node's value beyond some side is neither the value of the opposite cell nor the
    /// value of the cell beside the side. Such a node is called open. Its plane has no halo, and
    /// its values beyond the side are recomputed.
    bool is_open(NodeId id) const;
    /// The rules that fill the halo of the node's plane. Not for open nodes.
    Boundaries boundary(NodeId id) const;
    /// Whether the node is in a plane from the start: a species, a parameter that varies, a file,
    /// or the metric.
    bool is_plane(NodeId id) const;
    /// The name of the definition or rate whose value this node is; "" for other nodes.
    const std::string& name(NodeId id) const;
    /// The rules at sides of the definition whose value the node is. nullptr if the node is not the
    /// value of a definition with its own rules.
    const DefinitionSides* sides(NodeId id) const;
    std::optional<std::size_t> wall(NodeId id) const;
    /// Where the node is in the script. Null if a pass made the node.
    const Origin* origin(NodeId id) const;
    NodeId position(NodeId id) const { return expressions_.graph.written(id).position; }

    const Expressions& expressions() const { return expressions_; }
    const Program& program() const { return context_.program; }
    std::uint32_t stage() const { return context_.stage; }
    bool has_mask() const { return context_.has_mask(); }
    /// Whether cells read neighbours over links. If so, operators read only planes, and a `lap`
    /// with two operands means div(first * grad(second)).
    bool is_linked() const { return context_.has_links(); }
    const PassContext& context() const { return context_; }
    const Grid& grid() const { return context_.grid(); }

private:
    struct Facts {
        bool is_uniform = false, is_step_invariant = false;
        std::array<Beyond, 3> beyond{};  ///< The value beyond the sides of each axis.
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
