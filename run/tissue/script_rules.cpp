// Each group of formulas is a plan. If the planes of the cells have moved in memory, the passes of
// the plan are bound again.
#include "run/tissue/script_rules.h"

#include "core/check.h"
#include "lang/calculus/margin.h"
#include "lang/lower/lower.h"
#include "solvers/error_estimate.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

/// Whether the passes read the time, the number of steps, or sums over all cells. Such values
/// change even if the planes do not.
bool changes(const StepProblem& problem) {
    return std::any_of(problem.passes.begin(), problem.passes.end(),
                       [](const StepProblem::Pass& pass) { return !pass.changing.empty(); });
}

bool is_written(const Formula& formula) { return !formula.nodes.empty(); }

}  // namespace

Formula component_of(const Formula& vector, int number) {
    Formula component = vector;
    const NodeId whole(component.nodes.size() - 1);
    Node node;
    node.kind = static_cast<double>(number);
    component.nodes.push_back(node);
    node.kind = Call{};
    node.function = Function::component;
    node.operand_count = 2;
    node.operands = {whole, NodeId(component.nodes.size() - 1)};
    component.nodes.push_back(node);
    return component;
}

ScriptRules::ScriptRules(TissueStage stage, Makers makers, std::shared_ptr<NearTriangles> near)
    : stage_(std::move(stage)), makers_(std::move(makers)), near_(std::move(near)) {
    const CellRules& rules = stage_.rules();
    const System& system = stage_.system();
    const auto plan_of = [&](const std::vector<Formula>& formulas) -> std::optional<StepPlan> {
        if (formulas.empty()) return std::nullopt;
        std::vector<const Formula*> each;
        for (const Formula& formula : formulas) each.push_back(&formula);
        return plan_view(stage_.program, each, stage_.stage);
    };
    rates_.plan = plan_rates(stage_.program, stage_.stage);
    std::vector<Formula> conditions, along;
    for (const Formula* condition : {&rules.divide, &rules.die}) {
        if (is_written(*condition)) conditions.push_back(margin_of(*condition));
    }
    for (int k = 0; k < 3 && is_written(rules.along); ++k) {
        along.push_back(component_of(rules.along, k));
    }
    conditions_.plan = plan_of(conditions);
    along_.plan = plan_of(along);
    const auto is_restarted = [](const Formula& restart) { return is_written(restart); };
    if (!std::any_of(rules.restarts.begin(), rules.restarts.end(), is_restarted)) return;
    restarts_.plan = plan_restarts(stage_.program, stage_.stage);
    for (const ItemId item : restarts_.plan->results) {
        const auto species = system.species_of(item);
        restarted_.push_back(species ? species->index() : system.species_count() + item.index());
    }
}

std::vector<const StepPlan*> ScriptRules::all_plans() {
    std::vector<const StepPlan*> plans;
    for (const Values* values : {&rates_, &conditions_, &along_, &restarts_}) {
        if (values->plan) plans.push_back(&*values->plan);
    }
    return plans;
}

BindingContext ScriptRules::context() const {
    BindingContext context = stage_.fields;
    context.grid = grid_;
    context.tissue = &binding_;
    return context;
}

void ScriptRules::bind(const Tissue& tissue, const Links& links) {
    grid_ = tissue.grid();
    binding_ = binding_of(stage_, tissue, all_plans(), near_);
    binding_.links = &links;
    steps_.clear();
    for (Values* values : {&rates_, &conditions_, &along_, &restarts_}) values->problem.reset();
}

TissueStep ScriptRules::step(std::uint32_t stages) {
    const auto [known, is_new] = steps_.try_emplace(stages);
    Step& step = known->second;
    if (is_new) {
        const System& system = stage_.system();
        Scheme scheme = make_scheme(stage_.program.stages[stage_.stage].time.solver,
                                    system.species_count(), false, stages);
        if (!scheme.error_register) scheme = with_error_estimate(std::move(scheme));
        std::vector<StepPlan> sweeps;
        for (const SweepForm& form : scheme.forms) {
            sweeps.push_back(makers_.plans.sweep(stage_.stage, form));
        }
        step.problem = std::make_unique<StepProblem>(
            bind_scheme(scheme, sweeps, {}, makers_.steps, context(), system, stage_.stage));
        step.states = state_registers(scheme);
    }
    return {step.problem.get(), step.states};
}

CellValues ScriptRules::values_of(Values& values, const Compile& compile) {
    if (!values.plan) return {};
    if (!values.problem) {
        values.problem = std::make_unique<StepProblem>(
            bind_plan(*values.plan, compile, context(), stage_.system(), stage_.stage));
    }
    return {values.problem.get(), values.plan->result_count,
            !reads_links(*values.plan) && !changes(*values.problem)};
}

TissueRules::Conditions ScriptRules::conditions() {
    const bool divides = is_written(stage_.rules().divide);
    Conditions conditions{values_of(conditions_, makers_.steps), std::nullopt, std::nullopt};
    if (divides) conditions.divide = 0;
    if (is_written(stage_.rules().die)) conditions.die = divides ? 1 : 0;
    return conditions;
}

}  // namespace cascade
