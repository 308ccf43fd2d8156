// Makes the plans of a stage: for starting values, rates, sides and views.
#include "lang/lower/lower.h"

#include "core/check.h"
#include "lang/lower/lower_expressions.h"
#include "lang/lower/step_graph.h"
#include "lang/lower/step_invariants.h"
#include "lang/program/cell_items.h"
#include "lang/program/dependencies.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <utility>

namespace cascade {

namespace lowering {

StepGraph::StepGraph(const Program& program, std::uint32_t stage, const PlanOptions& options)
    : graph(lower_expressions(flat_step(program, stage), context_of_steps(program, stage)),
            context_of_steps(program, stage)) {
    const System& system = program.system_of(stage);
    const std::size_t rate_count = system.rate_order.size();
    const std::vector<NodeId>& roots = graph.roots();
    rates.resize(system.quantities.size());
    for (std::size_t k = 0; k < rate_count; ++k) rates[system.rate_order[k]] = roots[k];
    auto next = roots.begin() + static_cast<std::ptrdiff_t>(rate_count);
    for (std::size_t k = 0; k < system.invariants.size(); ++k) bounds.push_back(*next++);
    if (next != roots.end()) derivatives.resize(system.species_count());
    for (std::vector<NodeId>& row : derivatives) {
        for (std::size_t k = 0; k < derivatives.size(); ++k) row.push_back(*next++);
    }
    if (options.keeps_step_invariants) step_invariants = step_invariant_nodes(graph, roots);
    const std::vector<NodeId> weights = tensor_weight_nodes(graph, roots);
    step_invariants.insert(step_invariants.end(), weights.begin(), weights.end());
    tensor_weights = static_cast<std::uint32_t>(weights.size());
}

namespace {

/// The value of views outside of the mask.
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// Plans the starting values of some items: of the items that are computed before the cells have
/// been made (`before_cells`), or of all other items. The plan reads the items that other plans
/// compute.
StepPlan plan_items(const Program& program, std::uint32_t stage, const PlanOptions& options,
                    bool before_cells) {
    const Stage& source = program.stages[stage];
    const IdVector<ItemId, bool> late = items_of_aggregates(source);
    std::vector<ItemId> items;
    for (const ItemId item : source.order) {
        if (is_component_of_place(program.system_of(stage), item)) continue;
        if ((source.uniform[item] && !late[item]) == before_cells) items.push_back(item);
    }
    const PassContext context = context_of_start(program, stage);
    const PlanGraph graph(lower_expressions(flat_start(program, stage, items), context), context);
    PlanBuilder builder({graph, graph.roots(), options});
    for (std::size_t k = 0; k < items.size(); ++k) {
        const ValueId value = builder.value(graph.roots()[k])[0];
        builder.result(std::string(program.system_of(stage).item_name(items[k])),
                       source.uniform[items[k]] ? value
                                                : builder.last_pass().within_mask(value, 0));
    }
    StepPlan plan = std::move(builder).finish();
    plan.results = std::move(items);
    return plan;
}

}  // namespace

}  // namespace lowering

namespace {

using lowering::Expressions;
using lowering::PassContext;
using lowering::PlanBuilder;
using lowering::PlanGraph;
using lowering::StepGraph;

}  // namespace

StepPlan plan_uniform_start(const Program& program, std::uint32_t stage) {
    return lowering::plan_items(program, stage, {}, true);
}

StepPlan plan_start(const Program& program, std::uint32_t stage, const PlanOptions& options) {
    return lowering::plan_items(program, stage, options, false);
}

StepPlan plan_rates(const Program& program, std::uint32_t stage, const PlanOptions& options) {
    const System& system = program.system_of(stage);
    const StepGraph step(program, stage, options);
    const auto species = system.species();
    std::vector<NodeId> wanted;
    for (const ItemId item : system.rate_order) wanted.push_back(step.rates[item]);
    PlanBuilder builder({step.graph, wanted, options, true, species, step.step_invariants});
    for (const ItemId item : species) {
        builder.result(system.quantities[item].name,
                       builder.last_pass().within_mask(builder.value(step.rates[item])[0], 0));
    }
    StepPlan plan = std::move(builder).finish();
    plan.results = species;
    return plan;
}

StepPlan plan_step_invariants(const Program& program, std::uint32_t stage,
                              const PlanOptions& options) {
    const StepGraph step(program, stage, options);
    std::vector<NodeId> wanted(step.step_invariants.begin(),
                               step.step_invariants.end() - step.tensor_weights);
    for (std::size_t k = wanted.size(); k < step.step_invariants.size(); ++k) {
        const auto operands = step.graph[step.step_invariants[k]].reads();
        wanted.insert(wanted.end(), operands.begin(), operands.end());
    }
    PlanBuilder builder({step.graph, wanted, options, true});
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        const std::string& name = step.graph.name(wanted[k]);
        builder.result(name.empty() ? fmt::format("(step-invariant {})", k) : name,
                       builder.value(wanted[k])[0]);
    }
    StepPlan plan = std::move(builder).finish();
    plan.tensor_weights = step.tensor_weights;
    for (PassTarget& target : plan.passes.back().targets) {
        const auto* const result = std::get_if<ResultId>(&target.id);
        if (result == nullptr) continue;
        const NodeId node = wanted[result->index()];
        target.is_uniform = step.graph.is_uniform(node);
        target.boundary = step.graph.boundary(node);
    }
    return plan;
}

SidePlans plan_side(const Program& program, const SideSetting& setting, Side side,
                    std::uint32_t stage) {
    CHECK(setting.kind != SideKind::flux, "lowering: a flux has been made a slope");
    const PassContext context{program, stage};
    const std::array formula{&setting.value};
    Expressions lowered = lower_expressions(flat_formulas(formula, context), context);
    if (setting.kind == SideKind::slope) {
        lowered.roots[0] = across_side(lowered.graph, context, lowered.roots[0], side);
    }
    const PlanGraph graph(std::move(lowered), context, lowering::Draws::once);
    const NodeId value = graph.roots()[0];
    SidePlans plans;
    plans.changes = !graph.is_step_invariant(value);
    std::vector<NodeId> step_invariants;
    if (plans.changes) step_invariants = largest_step_invariants(graph, graph.roots());
    PlanBuilder once({graph, step_invariants, {}});
    for (const NodeId each : step_invariants) once.result("step-invariant", once.value(each)[0]);
    plans.once = std::move(once).finish();
    PlanBuilder each({graph, graph.roots(), {}, false, {}, step_invariants});
    each.result("value", each.value(value)[0]);
    plans.each = std::move(each).finish();
    return plans;
}

StepPlan plan_view(const Program& program, std::span<const Formula* const> formulas,
                   std::uint32_t stage, const PlanOptions& options) {
    const PassContext context{program, stage};
    const PlanGraph graph(lower_expressions(flat_formulas(formulas, context), context), context);
    PlanBuilder builder({graph, graph.roots(), options});
    static constexpr std::array<const char*, 3> channels{"red", "green", "blue"};
    for (const NodeId root : graph.roots()) {
        const bool is_number = graph[root].type != ValueType::colour;
        for (std::size_t channel = 0; channel < (is_number ? 1 : 3); ++channel) {
            const ValueId value = builder.value(root)[channel];
            builder.result(is_number ? "value" : channels[channel],
                           graph.is_uniform(root)
                               ? value
                               : builder.last_pass().within_mask(value, lowering::nothing));
        }
    }
    return std::move(builder).finish();
}

StepPlan plan_restarts(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    CHECK(system.cells, "lowering: cells divide");
    Expressions flat;
    Flattening flattening(flat.graph);
    std::vector<ItemId> items;
    for (const ItemId item : system.cells->restarts.ids()) {
        const Formula& formula = system.cells->restarts[item];
        if (formula.nodes.empty()) continue;
        items.push_back(item);
        const std::string name(system.item_name(item));
        flat.roots.push_back(flattening.add(formula, {name + " after divide", false}));
    }
    flat.origins = flattening.origins();
    const PassContext context{program, stage};
    const PlanGraph graph(lower_expressions(std::move(flat), context), context);
    PlanBuilder builder({graph, graph.roots(), {}});
    for (std::size_t k = 0; k < items.size(); ++k) {
        builder.result(std::string(system.item_name(items[k])), builder.value(graph.roots()[k])[0]);
    }
    StepPlan plan = std::move(builder).finish();
    plan.results = std::move(items);
    return plan;
}

StepPlan plan_view(const Program& program, const Formula& formula, std::uint32_t stage) {
    const Formula* only = &formula;
    return plan_view(program, std::span(&only, 1), stage);
}

StepPlan plan_mask(const Program& program) {
    CHECK(program.domain.mask, "lowering: the domain has a mask");
    const PassContext context{program, 0, lowering::Extent::grid};
    const std::array formula{&program.domain.mask->formula};
    const PlanGraph graph(
        lower_expressions(flat_formulas(formula, context, {"mask", false, "domain"}), context),
        context);
    PlanBuilder builder({graph, graph.roots(), {}});
    builder.result("mask", builder.value(graph.roots()[0])[0]);
    return std::move(builder).finish();
}

std::string describe_graphs(const Program& program) {
    std::string text;
    lowering::watch_lowering(program, [&](const PassContext& context, std::string_view what,
                                          std::string_view pass, const Expressions& after) {
        text += fmt::format("# stage '{}': {}, after {}\n{}\n", program.stages[context.stage].name,
                            what, pass, print(after, context));
    });
    return text;
}

std::string describe_plans(const Program& program) {
    const PlanOptions options{Materialise::when_cheaper, true, true};
    std::string text;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const std::string& name = program.stages[k].name;
        text += fmt::format("stage '{}', starting values: {}\n", name,
                            plan_start(program, k, options).words);
        if (const StepPlan once = plan_step_invariants(program, k, options);
            once.result_count > 0) {
            text += fmt::format("stage '{}', once before the first step: {}\n", name, once.words);
        }
        text +=
            fmt::format("stage '{}', one step: {}\n", name, plan_step(program, k, options).words);
    }
    return text;
}

}  // namespace cascade
