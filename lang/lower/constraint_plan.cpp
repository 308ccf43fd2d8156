// Finds the linear part of an expression node by node. The linear part is a sum of linear parts, or
// an operator applied to a linear part. Values that do not depend on the unknown are computed once
// for each solution.
#include "lang/lower/constraint_plan.h"

#include "lang/lower/plan_builder.h"

#include <memory>
#include <optional>
#include <utility>

namespace cascade::lowering {

namespace {

using LinearParts = IdVector<NodeId, std::optional<NodeId>>;

/// Adds the linear part of a node to the graph. Empty if the node does not depend on the unknown.
std::optional<NodeId> linear_part(ExpressionGraph& graph, NodeId id, const LinearParts& parts) {
    Node node = graph[id];
    if (node.is<Unknown>()) return id;
    bool depends = false;
    for (const NodeId operand : node.reads()) depends = depends || parts[operand].has_value();
    if (!depends) return std::nullopt;
    if (node.calls(Function::add) || node.calls(Function::subtract)) {
        const auto first = parts[node.operands[0]], second = parts[node.operands[1]];
        if (!second) return first;
        if (!first && node.calls(Function::add)) return second;
        if (!first) return graph.call(Function::negate, {*second}, node.type);
    }
    const NodeId zero = graph.number(0);
    for (std::size_t k = 0; k < node.operand_count; ++k) {
        NodeId& operand = node.operands[k];
        if (parts[operand]) {
            operand = *parts[operand];
        } else if (is_jointly_linear(node.function) &&
                   is_linear_in(node.function, k, node.operand_count)) {
            operand = zero;  // Terms without the unknown do not contribute.
        }
    }
    return graph.add(node);
}

/// The linear part of `root`, as a separate graph.
Expressions linear_part(const Expressions& from, NodeId root) {
    Expressions linear = from;
    LinearParts parts;
    for (const NodeId id : ids_below<NodeId>(root.index() + 1)) {
        parts.push_back(linear_part(linear.graph, id, parts));
    }
    linear.roots = {parts[root] ? *parts[root] : linear.graph.number(0)};
    return linear;
}

/// The largest nodes that vary, do not depend on the unknown, and are not in a plane.
std::vector<NodeId> constant_parts(const PlanGraph& graph) {
    IdVector<NodeId, bool> depends, needed(graph.size(), false);
    for (const NodeId id : graph.ids()) {
        bool reads_it = graph[id].is<Unknown>();
        for (const NodeId operand : operands_of(graph[id])) reads_it = reads_it || depends[operand];
        depends.push_back(reads_it);
    }
    for (const NodeId root : graph.roots()) needed[root] = true;
    std::vector<NodeId> parts;
    for (const NodeId id : graph.ids_backwards()) {
        if (!needed[id]) continue;
        const bool is_kept = !depends[id] && !graph.is_uniform(id) && !graph.is_plane(id) &&
                             !graph.is_open(id) && graph[id].type == ValueType::number;
        if (is_kept) parts.insert(parts.begin(), id);
        if (is_kept) continue;
        for (const NodeId operand : operands_of(graph[id])) needed[operand] = true;
    }
    return parts;
}

/// A plan for values that are 0 outside the mask.
std::shared_ptr<const StepPlan> plan_of(const PlanGraph& graph, std::span<const NodeId> wanted,
                                        std::span<const NodeId> known) {
    PlanBuilder builder({graph, wanted, {}, false, {}, known});
    for (const NodeId id : wanted) {
        builder.result("value", builder.last_pass().within_mask(builder.value(id)[0], 0));
    }
    StepPlan plan = std::move(builder).finish();
    std::size_t next = 0;
    for (PassTarget& target : plan.passes.back().targets) {
        if (std::holds_alternative<ResultId>(target.id)) {
            target.boundary = graph.boundary(wanted[next++]);
        }
    }
    return std::make_shared<const StepPlan>(std::move(plan));
}

}  // namespace

Solve plan_of_constraint(const PlanGraph& graph, NodeId solved, TemporaryId target) {
    const Node& node = graph[solved];
    const NodeId root = node.operands[0];
    Solve solve;
    solve.target = target;
    solve.constraint = node.as<Call>()->detail;
    solve.stage = graph.stage();
    solve.boundary = graph.boundary(solved);
    solve.wall = graph.wall(solved);
    Expressions whole = graph.expressions();
    whole.roots = {root};
    const PlanGraph of_whole(std::move(whole), graph.context());
    solve.whole = plan_of(of_whole, of_whole.roots(), {});
    const PlanGraph linear(linear_part(graph.expressions(), root), graph.context());
    const std::vector<NodeId> parts = constant_parts(linear);
    solve.linear = plan_of(linear, linear.roots(), parts);
    if (!parts.empty()) solve.parts = plan_of(linear, parts, {});
    return solve;
}

}  // namespace cascade::lowering
