// The values of a pass that change from step to step: its uniforms, and the rules at the sides of
// its results.
#pragma once

#include "solvers/pass_runner.h"
#include "solvers/step_problem.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The value of a uniform that changes from step to step, computed as in PassRunner. 0 for
/// aggregates.
template <typename Number>
Number passed_value(const StepProblem::ChangingUniform& uniform, const StepMoment& moment);

/// The rules of a result's sides at the moment at which neighbours will read the result, found as
/// in PassRunner.
SideRules halo_rules_at(const StepProblem& problem, const StepProblem::Result& result,
                        const StepMoment& moment);

/// The rules of several planes as numbers, for a kernel that fills halos. SideKind is a number: 0
/// periodic, 1 no_flux, 2 fixed, 3 slope.
struct HaloRecords {
    /// 12 numbers for each plane: the kinds of the six sides, then for each side the position of
    /// its first value in `values`, or -1 if the side has a single value.
    std::vector<std::int32_t> kinds;
    /// 7 numbers for each plane: the value of each side, then the spacing.
    std::vector<double> numbers;
    std::vector<double> values;

    explicit HaloRecords(const std::vector<SideRules>& rules);
};

}  // namespace cascade
