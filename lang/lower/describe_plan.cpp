// Plans in words, for `--dump plan`.
#include "core/counted.h"
#include "lang/lower/plan_builder.h"
#include "lang/print/print_formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace cascade::lowering {

namespace {

/// Longer formulas are only counted.
constexpr std::uint32_t most_parts_shown = 60;

/// Parts that nobody has written: those of a tensor, and of operators on a surface.
std::string describe_made(const PartGraph& graph, const Part& part) {
    const bool is_round = part.calls(Function::sin) || part.calls(Function::cos);
    if (is_round && graph[part.operands[0]].formula != nullptr) {
        return fmt::format("the {} of a direction", part.calls(Function::sin) ? "sine" : "cosine");
    }
    return "an entry of a tensor";
}

/// How a part is written, or what it is called.
std::string name_of(const PartGraph& graph, PartId id) {
    const std::string& name = graph.name(id);
    if (!name.empty()) return name;
    const Part& part = graph[id];
    if (part.calls(Function::if_) && graph[part.operands[0]].node.kind == NodeKind::inside) {
        return name_of(graph, part.operands[1]) + " inside the mask";
    }
    if (part.formula == nullptr) return describe_made(graph, part);
    if (part.position > most_parts_shown) return "a long expression";
    Formula formula;
    const auto& nodes = part.formula->nodes;
    formula.nodes.assign(nodes.begin(), nodes.begin() + part.position + 1);
    return print_formula(graph.program(), graph.program().system_of(graph.stage()), formula);
}

std::string describe_choice(const PartGraph& graph, const PassPlanner::OperandChoice& choice) {
    const std::string reader = name_of(graph, choice.reader);
    const std::string operand = name_of(graph, choice.operand);
    if (choice.places == 0) {
        return fmt::format("{} is written to a plane: {} takes all its cells", operand, reader);
    }
    const std::string neighbours = counted(choice.places, "neighbour");
    if (choice.is_open) {
        return fmt::format(
            "{} is computed again at {} for {}: beyond a side it is made of what "
            "stands there",
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

std::string describe_step_invariant(const PartGraph& graph, PartId id) {
    const std::string name = name_of(graph, id);
    if (graph[id].is_uniform) return fmt::format("{} is computed once: no step changes it", name);
    return fmt::format(
        "{} is computed once and kept in a plane: no step changes it, and computing it "
        "again would take longer than reading it",
        name);
}

}  // namespace

std::string describe(const PartGraph& graph, const PassPlanner& planner, const StepPlan& plan) {
    std::string text = counted(plan.passes.size(), "pass");
    if (plan.temporaries > 0) text += ", " + counted(plan.temporaries, "temporary plane");
    if (plan.aggregates > 0) text += ", " + counted(plan.aggregates, "aggregate");
    if (plan.step_invariants > 0)
        text += ", " + counted(plan.step_invariants, "step-invariant part");
    for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
        const std::vector<std::string>& results = plan.passes[pass].bound.kernel.result_names;
        if (results.empty()) continue;
        text += fmt::format("\n  pass {}", pass + 1);
        if (!plan.passes[pass].reductions.empty()) {
            text += fmt::format(", after {}",
                                counted(plan.passes[pass].reductions.size(), "aggregate"));
        }
        text += ": ";
        for (std::size_t k = 0; k < results.size(); ++k) text += (k > 0 ? ", " : "") + results[k];
    }
    std::vector<std::pair<std::string, std::size_t>>
        step_invariants;  // And how many parts of one name.
    for (PartId id = 0; id < graph.size(); ++id) {
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
