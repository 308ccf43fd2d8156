// Evaluates formulas and rates from the present values of a stage.
#include "run/simulation/stage_view.h"

#include "lang/calculus/derivative.h"
#include "run/domain/domain_mask.h"
#include "run/domain/tensor_links.h"
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

/// If the formula is nothing but a species of this stage, returns the plane of this species, which
/// can be copied. Otherwise returns null.
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

StepInvariants StageView::step_invariants(const StepPlan& once) const {
    // The results for weights by tensors, three for each, follow all other results.
    const std::uint32_t others = once.result_count - 3 * once.tensor_weights;
    StepInvariants found(others + once.tensor_weights);
    if (found.empty()) return found;
    std::vector<Field> planes = evaluate(once);
    for (std::uint32_t k = 0; k < once.tensor_weights; ++k) {
        const Field* const operands = &planes[others + 3 * k];
        const TensorLinks& links = environment_->model->cells->tensor_links();
        found[StepInvariantId(others + k)].plane =
            links.weights(operands[0], operands[1], operands[2]);
    }
    for (const PassTarget& target : once.passes.back().targets) {
        const auto* const result = std::get_if<ResultId>(&target.id);
        if (result == nullptr || result->index() >= others) continue;
        Field& plane = planes[result->index()];
        StepInvariant& part = found[StepInvariantId(result->index())];
        part.boundary = target.boundary;
        if (target.is_uniform) {
            part.number = plane.number_at(0, 0);
        } else {
            part.plane = std::move(plane);
        }
    }
    return found;
}

/// Calls use(view, plan) with a plan of the rates and a view with the step-invariants that the plan
/// reads. These step-invariants are computed anew, because rates are also needed before a stage has
/// its own.
template <typename Use>
auto StageView::with_rates(const Use& use) const {
    const StepPlan plan = plan_rates(program(), number_);
    if (plan.step_invariants == 0) return use(*this, plan);
    const StepInvariants own = step_invariants(plan_step_invariants(program(), number_, {}));
    StageView view = *this;
    view.use(own);
    return use(view, plan);
}

std::vector<Field> StageView::rates() const {
    return with_rates(
        [](const StageView& view, const StepPlan& plan) { return view.evaluate(plan); });
}

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
    // Frozen cells cannot blow up, so they are left out. The rates themselves ignore `frozen`.
    const Mask* frozen = state().frozen().empty() ? nullptr : &state().frozen();
    const DomainMask* inside = environment_->inside();
    const Mask still = inside != nullptr ? still_cells(*inside, frozen) : Mask();
    if (inside != nullptr) frozen = &still;
    return with_rates([&](const StageView& view, const StepPlan& plan) {
        const StepProblem rates = bind_plan(plan, compile, view.context(), system(), number_);
        return estimate_stability(rates, species, frozen, cancel);
    });
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
