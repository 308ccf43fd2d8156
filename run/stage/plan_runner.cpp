// Binds the plan again before each run, because planes may have moved in memory. Then runs its
// passes once.
#include "run/stage/plan_runner.h"

#include <array>
#include <span>
#include <utility>

namespace cascade {

PlanRunner::PlanRunner(StepPlan plan, Compile compile)
    : plan_(std::move(plan)), compile_(std::move(compile)) {}

std::vector<Field>& PlanRunner::run(const BindingContext& context, Team& team) {
    const Compile make_once = [this](const CellKernel& kernel) {
        KernelPointer& known = made_[&kernel];
        if (!known) known = compile_(kernel);
        return known;
    };
    // Planes may have moved in memory since the last run.
    problem_ = bind_plan(plan_, make_once, context);
    if (!runner_) {
        runner_.emplace(problem_);
        for (std::uint32_t k = 0; k < plan_.result_count; ++k) {
            results_.emplace_back(PlaneLayout(context.grid), context.precision);
        }
    }
    const std::array<std::span<Field>, 2> registers{std::span<Field>(), results_};
    runner_->run_once(team, registers, {context.steps, context.t, 0, context.t});
    return results_;
}

std::vector<Field> run_plan(const StepPlan& plan, const Compile& compile,
                            const BindingContext& context, const Grid& on, Team& team) {
    BindingContext here = context;
    here.grid = on;
    return std::move(PlanRunner(plan, compile).run(here, team));
}

}  // namespace cascade
