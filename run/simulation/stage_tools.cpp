// Binds the passes of steps, and computes the numbers from which their length is chosen.
#include "run/simulation/stage_tools.h"

#include "run/domain/field_values.h"
#include "run/simulation/values_over_time.h"
#include "run/stage/bound_diffusion.h"
#include "run/stage/plan_runner.h"

#include <memory>
#include <utility>

namespace cascade {
namespace {

NumberSource numbers_of(const StageView& view, std::span<const Formula* const> formulas) {
    const auto runner =
        std::make_shared<PlanRunner>(plan_view(view.program(), formulas, view.number()),
                                     view.environment().kernels->often());
    return [view, runner] {
        return first_values(runner->run(view.context(), *view.environment().team));
    };
}

StepProblem bind_steps(const StageView& view, const Scheme& scheme, const Compile& compile) {
    const Environment& here = view.environment();
    const std::uint32_t k = view.number();
    const TimeAccount::Scope spent(here.account, Spent::compiling);
    std::vector<StepPlan> sweeps;
    for (const SweepForm& form : scheme.forms) sweeps.push_back(here.plans->sweep(k, form));
    const auto bind = [&](const StepPlan& before) {
        return bind_scheme(scheme, sweeps, before, compile, view.context(), view.system(), k);
    };
    if (!is_semi_implicit(view.stage().time.solver)) return bind({});
    const auto largest = [&](std::span<const Formula* const> formulas) {
        std::vector<double> values;
        for (const Field& field : view.evaluate(formulas)) {
            values.push_back(largest_value(field, here.inside()));
        }
        return values;
    };
    const BoundDiffusion diffusion(view.program(), k, largest);
    StepProblem problem = bind(diffusion.before());
    diffusion.add_to(problem);
    return problem;
}

}  // namespace

StageTools stage_tools(const StageView& view, Compile steps) {
    const Environment& here = view.environment();
    StageTools tools;
    tools.bind = [view, compile = std::move(steps)](const Scheme& scheme) {
        return bind_steps(view, scheme, compile);
    };
    tools.numbers = [view](std::span<const Formula* const> formulas) {
        return numbers_of(view, formulas);
    };
    tools.at_time = [view](const Formula& formula) { return values_at(view, formula); };
    tools.motion = [view](const Formula& formula, double duration) {
        return motion_over(view, formula, duration);
    };
    tools.condition_holds = [view, condition = NumberSource()]() mutable {
        if (!condition) {
            const Formula* const until[] = {&*view.stage().time.until};
            condition = numbers_of(view, until);
        }
        return condition()[0] != 0;
    };
    tools.estimate = [view, compile = here.kernels->often()] {
        const auto limit = view.stability(view.state().species, compile).largest_speed;
        return limit ? 2 / *limit : 0;
    };
    tools.inside = here.counted();
    tools.model = here.model_facts();
    return tools;
}

StepInvariants find_step_invariants(const StageView& view) {
    const Environment& here = view.environment();
    const TimeAccount::Scope spent(here.account, Spent::starting);
    const StepPlan& once = here.plans->step_invariants(view.number());
    StepInvariants found(once.result_count);
    if (found.empty()) return found;
    std::vector<Field> planes = view.evaluate(once);
    for (const PassTarget& target : once.passes.back().targets) {
        const auto* const result = std::get_if<ResultId>(&target.id);
        if (result == nullptr) continue;
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

}  // namespace cascade
