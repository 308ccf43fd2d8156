// Stores plans by their stages and forms of sweep.
#include "run/stage/stage_plans.h"

namespace cascade {

const StepPlan& StagePlans::start(std::uint32_t stage) {
    std::optional<StepPlan>& plan = starts_[stage];
    if (!plan) plan = plan_start(*program_, stage);
    return *plan;
}

const StepPlan& StagePlans::step_invariants(std::uint32_t stage) {
    std::optional<StepPlan>& plan = step_invariant_[stage];
    if (!plan) plan = plan_step_invariants(*program_, stage, options_);
    return *plan;
}

const StepPlan& StagePlans::sweep(std::uint32_t stage, const SweepForm& form) {
    for (const auto& [known, plan] : sweeps_[stage]) {
        if (known == form) return plan;
    }
    return sweeps_[stage].emplace_back(form, plan_sweep(*program_, stage, form, options_)).second;
}

}  // namespace cascade
