// Evaluates formulas and rates from the present values of a stage.
#include "run/simulation/stage_view.h"

#include "lang/calculus/derivative.h"
#include "run/domain/domain_mask.h"
#include "run/simulation/tissue_stage.h"
#include "run/stage/plan_runner.h"

#include <cmath>
#include <utility>

namespace cascade {

BindingContext StageView::context() const {
    const Environment& here = *environment_;
    return {states_,          here.files,
            state().steps,    here.grid,
            here.precision(), state().t,
            here.metric,      here.model ? here.model->cells.get() : nullptr,
            here.inside(),    here.model ? here.model->values.get() : nullptr,
            invariants_};
}

/// Runs a plan in the cells of the domain, or in the crawling cells. evaluate_in_cells() explains
/// `formulas`.
std::vector<Field> StageView::run(const StepPlan& plan,
                                  std::span<const Formula* const> formulas) const {
    if (state().tissue() != nullptr) return evaluate_in_cells(*this, plan, formulas);
    return run_plan(plan, environment_->kernels.once(), context(), environment_->grid,
                    environment_->team);
}

/// The species of this stage if the formula is nothing but this species, whose plane can be copied.
/// Null otherwise.
const Field* StageView::species_alone(const Formula& formula) const {
    if (state().tissue() != nullptr || environment_->inside() != nullptr ||
        formula.nodes.size() != 1) {
        return nullptr;
    }
    const auto* const item = formula.nodes.back().as<ItemId>();
    const auto species = item != nullptr ? state().species_of_item[*item] : std::nullopt;
    return species ? &state().species()[species->index()] : nullptr;
}

std::vector<Field> StageView::evaluate(std::span<const Formula* const> formulas) const {
    if (environment_->model) environment_->model->values->prepare(formulas);
    return run(plan_view(program(), formulas, number_), formulas);
}

std::vector<Field> StageView::evaluate(const Formula& formula) const {
    if (const Field* const species = species_alone(formula)) {
        std::vector<Field> values;
        values.push_back(species->clone());
        return values;
    }
    const Formula* const formulas[] = {&formula};
    return evaluate(formulas);
}

std::vector<Field> StageView::rates() const { return evaluate(plan_rates(program(), number_)); }

std::vector<Field> StageView::starting_species() const {
    const StepPlan& plan = environment_->plans.start(number_);
    std::vector<Field> values = evaluate(plan);
    std::vector<Field> species(state().species().size());
    for (std::size_t r = 0; r < values.size(); ++r) {
        const auto id = state().species_of_item[plan.results[r]];
        if (id) species[id->index()] = std::move(values[r]);
    }
    return species;
}

StabilityEstimate StageView::stability(std::span<const Field> species, const Compile& compile,
                                       const std::atomic<bool>* cancel) const {
    // Rates ignore `frozen`, so frozen cells are left out here. They cannot blow up.
    const Mask* frozen = state().frozen().empty() ? nullptr : &state().frozen();
    const DomainMask* inside = environment_->inside();
    const Mask still = inside != nullptr ? still_cells(*inside, frozen) : Mask();
    if (inside != nullptr) frozen = &still;
    const StepProblem rates =
        bind_plan(plan_rates(program(), number_), compile, context(), system(), number_);
    return estimate_stability(rates, species, frozen, cancel);
}

bool StageView::is_frozen() const {
    const ItemId item = system().frozen_item();
    return stage().uniform[item] && state().numbers[item] != 0;
}

StepInUse StageView::step_in_use() const {
    const StageTime& time = stage().time;
    const ItemId speed = system().speed_item();
    StepInUse use;
    use.speed = state().time.clock.step;
    if (!(use.speed > 0)) use.speed = stage().uniform[speed] ? state().numbers[speed] : NAN;
    use.solver = time.solver;
    use.is_chosen = time.chooses_steps();
    if (!time.has_duration() && !time.open_end) use.iterations = stage().iterations;
    return use;
}

bool StageView::diffusion_limits() const {
    constexpr double worth_changing = 4;
    const Solver solver = stage().time.solver;
    if (solver == Solver::symplectic || takes_long_steps(solver)) return false;
    const auto bound = jacobian_bound(program(), number_, environment_->model_facts());
    if (!bound || bound->jumps) return false;
    const Formula* const formulas[] = {&bound->whole, &bound->reaction};
    const std::vector<Field> bounds = evaluate(formulas);
    const double whole = bounds[0].number_at(0, 0), reaction = bounds[1].number_at(0, 0);
    return std::isfinite(whole) && whole > worth_changing * reaction;
}

OtherSpecies::OtherSpecies(StageState& state, std::vector<Field> species)
    : state_(state), own_(std::exchange(state.species(), std::move(species))) {
    state_.go_to(state_.steps, state_.t);
}

OtherSpecies::~OtherSpecies() {
    state_.species() = std::move(own_);
    state_.go_to(state_.steps, state_.t);
}

}  // namespace cascade
