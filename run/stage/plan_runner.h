// Runs plans that are no steps: starting values, views, and numbers that steps are chosen by.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "run/stage/bound_kernel.h"
#include "solvers/pass_runner.h"

#include <optional>
#include <vector>

namespace cascade {

/// Runs a plan again and again. Its planes are made by the first run and used by all: fresh memory
/// would cost more than the work.
class PlanRunner {
public:
    PlanRunner(StepPlan plan, Compile compile);
    PlanRunner(const PlanRunner&) = delete;
    PlanRunner& operator=(const PlanRunner&) = delete;

    /// Over the present values, rows shared by the team; one field per result, which the next run
    /// overwrites. The grid and precision are those of the first run.
    std::vector<Field>& run(const BindingContext& context, Team& team);

private:
    StepPlan plan_;
    Compile compile_;
    StepProblem problem_;
    std::optional<PassRunner> runner_;
    std::vector<Field> results_;
};

/// Runs a plan once.
std::vector<Field> run_plan(const StepPlan& plan, const Compile& compile,
                            const BindingContext& context, const Grid& on, Team& team);

}  // namespace cascade
