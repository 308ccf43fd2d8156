// The plans of a program's stages. Each plan is made when it is first used, and then stored.
#pragma once

#include "lang/lower/lower.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {

class StagePlans {
public:
    /// `program` must outlive this object.
    StagePlans(const Program& program, const PlanOptions& options)
        : program_(&program),
          options_(options),
          starts_(program.stages.size()),
          step_invariant_(program.stages.size()),
          sweeps_(program.stages.size()) {}

    const PlanOptions& options() const { return options_; }
    /// Returns the plan of the starting values.
    const StepPlan& start(std::uint32_t stage);
    /// Returns the plan of the step-invariants.
    const StepPlan& step_invariants(std::uint32_t stage);
    /// Returns the plan of a sweep. A sweep is one evaluation of the rates.
    const StepPlan& sweep(std::uint32_t stage, const SweepForm& form);

private:
    const Program* program_;
    PlanOptions options_;
    std::vector<std::optional<StepPlan>> starts_, step_invariant_;
    /// For each stage, the plans of sweeps and their forms.
    std::vector<std::deque<std::pair<SweepForm, StepPlan>>> sweeps_;
};

}  // namespace cascade
