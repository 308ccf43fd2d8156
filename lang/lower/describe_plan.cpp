// Describes plans in words, for `--dump plan`.
#include "core/counted.h"
#include "lang/lower/plan_builder.h"
#include "lang/print/print_formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace cascade::lowering {

namespace {

/// A formula with more nodes than this number is cut in descriptions.
constexpr NodeId longest_shown{60};

/// The node whose value beyond the border of a mask is `beyond`. nullopt if there is none.
std::optional<NodeId> inside_of(const PlanGraph& graph, NodeId beyond) {
    for (const NodeId id : ids_below<NodeId>(graph.size())) {
        const Node& node = graph[id];
        if (!node.calls(Function::bordered)) continue;
        if (node.operands[1] == beyond || node.operands[2] == beyond) return node.operands[0];
    }
    return std::nullopt;
}

/// Describes a node that does not come from the script, such as an entry of a tensor, or a part of
/// an operator on a surface or a model.
std::string describe_made(const PlanGraph& graph, const Node& node) {
    if (graph.context().is_tissue()) return "a component of a vector";
    const bool is_sine = node.calls(Function::sin);
    if ((is_sine || node.calls(Function::cos)) && graph.origin(node.operands[0]) != nullptr) {
        return fmt::format("the {} of a direction", is_sine ? "sine" : "cosine");
    }
    return graph.is_linked() ? "a part of a flow" : "an entry of a tensor";
}

/// The name of a node, or its text if it has no name.
std::string name_of(const PlanGraph& graph, NodeId id) {
    const std::string& name = graph.name(id);
    if (!name.empty()) return name;
    const Node& node = graph[id];
    if (node.calls(Function::if_) && graph[node.operands[0]].is<InsideMask>()) {
        return name_of(graph, node.operands[1]) + " inside the mask";
    }
    if (node.calls(Function::bordered)) return name_of(graph, node.operands[0]);
    if (graph.origin(id) == nullptr) {
        const std::optional<NodeId> inside = inside_of(graph, id);
        return inside ? name_of(graph, *inside) + " beyond the border" : describe_made(graph, node);
    }
    if (graph.position(id) > longest_shown) return "a long expression";
    return print_formula(graph.program(), graph.program().system_of(graph.stage()),
                         formula_of(graph.origin(id)->formula->nodes, graph.position(id)));
}

std::string describe_choice(const PlanGraph& graph, const PassPlanner::OperandChoice& choice) {
    const std::string reader = name_of(graph, choice.reader);
    const std::string operand = name_of(graph, choice.operand);
    if (choice.places == 0) {
        return fmt::format("{} is written to a plane: {} reads all its cells", operand, reader);
    }
    const std::string neighbours = counted(choice.places, "neighbour");
    if (choice.is_open) {
        return fmt::format(
            "{} is computed again at {} for {}: beyond a side it depends on the values there",
            operand, neighbours, reader);
    }
    if (!choice.is_written) {
        return fmt::format("{} is computed again at {} for {}", operand, neighbours, reader);
    }
    return fmt::format("{} is written to a plane: {} reads it at {}, where {}", operand, reader,
                       neighbours,
                       choice.is_forced ? "it cannot be computed again"
                                        : "computing it again would take longer than reading it");
}

std::string describe_step_invariant(const PlanGraph& graph, NodeId id) {
    const std::string name = name_of(graph, id);
    if (graph.is_uniform(id)) return fmt::format("{} is computed once: no step changes it", name);
    return fmt::format(
        "{} is computed once and kept in a plane: no step changes it, and computing it "
        "again would take longer than reading it",
        name);
}

}  // namespace

std::string describe(const PlanGraph& graph, const PassPlanner& planner, const StepPlan& plan) {
    std::string text = counted(plan.passes.size(), "pass");
    if (plan.temporaries > 0) text += ", " + counted(plan.temporaries, "temporary plane");
    if (plan.aggregates > 0) text += ", " + counted(plan.aggregates, "aggregate");
    if (plan.step_invariants > 0)
        text += ", " + counted(plan.step_invariants, "step-invariant part");
    for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
        const std::vector<std::string>& results = plan.passes[pass].bound.kernel->result_names;
        if (results.empty()) continue;
        text += fmt::format("\n  pass {}", pass + 1);
        if (!plan.passes[pass].solves.empty()) {
            text +=
                fmt::format(", after {}", counted(plan.passes[pass].solves.size(), "constraint"));
        }
        if (!plan.passes[pass].convolutions.empty()) {
            text += fmt::format(", after {}",
                                counted(plan.passes[pass].convolutions.size(), "convolution"));
        }
        if (!plan.passes[pass].reductions.empty()) {
            text += fmt::format(", after {}",
                                counted(plan.passes[pass].reductions.size(), "aggregate"));
        }
        text += ": ";
        for (std::size_t k = 0; k < results.size(); ++k) text += (k > 0 ? ", " : "") + results[k];
    }
    // Descriptions of step-invariants, and how often each occurs in succession.
    std::vector<std::pair<std::string, std::size_t>> step_invariants;
    for (const NodeId id : graph.ids()) {
        if (!planner.is_needed(id) || !planner.is_step_invariant(id)) continue;
        std::string words = describe_step_invariant(graph, id);
        if (step_invariants.empty() || step_invariants.back().first != words)
            step_invariants.emplace_back(words, 0);
        ++step_invariants.back().second;
    }
    for (const auto& [words, count] : step_invariants) {
        text += "\n  " + words + (count > 1 ? fmt::format(" ({} times)", count) : "");
    }
    for (const PassPlanner::OperandChoice& choice : planner.choices()) {
        text += "\n  " + describe_choice(graph, choice);
    }
    return text;
}

}  // namespace cascade::lowering
