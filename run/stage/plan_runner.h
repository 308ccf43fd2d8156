// Runs plans other than steps: starting values, views, and numbers from which steps are chosen.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "run/stage/bound_kernel.h"
#include "solvers/pass_runner.h"

#include <map>
#include <optional>
#include <vector>

namespace cascade {

/// Runs a plan repeatedly. Its kernels are made and its planes allocated by the first run and
/// reused, because making them would cost more than the computation.
class PlanRunner {
public:
    PlanRunner(StepPlan plan, Compile compile);
    PlanRunner(const PlanRunner&) = delete;
    PlanRunner& operator=(const PlanRunner&) = delete;

    /// Computes the plan from the present values; the team shares the rows. Returns one field for
    /// each result, which the next run overwrites. Grid and precision are those of the first run.
    std::vector<Field>& run(const BindingContext& context, Team& team);

private:
    StepPlan plan_;
    Compile compile_;
    std::map<const CellKernel*, KernelPointer> made_;  ///< By the kernels of the plan.
    StepProblem problem_;
    std::optional<PassRunner> runner_;
    std::vector<Field> results_;
};

/// Runs a plan once.
std::vector<Field> run_plan(const StepPlan& plan, const Compile& compile,
                            const BindingContext& context, const Grid& on, Team& team);

}  // namespace cascade
