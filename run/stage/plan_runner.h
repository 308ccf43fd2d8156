// Runs plans that are not steps: starting values, formulas of pictures, and numbers that determine
// the length of steps.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "run/stage/bound_kernel.h"
#include "solvers/pass_runner.h"

#include <map>
#include <optional>
#include <vector>

namespace cascade {

/// Runs a plan repeatedly. The first run makes the kernels and allocates the planes. Later runs
/// reuse them, because making them again would cost more than the computation.
class PlanRunner {
public:
    PlanRunner(StepPlan plan, Compile compile);
    PlanRunner(const PlanRunner&) = delete;
    PlanRunner& operator=(const PlanRunner&) = delete;

    /// Computes the plan from the present values. The threads of the team share the rows. Returns
    /// one field for each result, which the next run overwrites. Grid and precision must be the
    /// same in all runs.
    std::vector<Field>& run(const BindingContext& context, Team& team);

private:
    StepPlan plan_;
    Compile compile_;
    /// Maps each kernel of the plan to the compiled kernel that can be run.
    std::map<const CellKernel*, KernelPointer> made_;
    StepProblem problem_;
    std::optional<PassRunner> runner_;
    std::vector<Field> results_;
};

/// Runs a plan once.
std::vector<Field> run_plan(const StepPlan& plan, const Compile& compile,
                            const BindingContext& context, const Grid& on, Team& team);

}  // namespace cascade
