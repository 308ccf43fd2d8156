// The diffusion of a stage's species, made ready for the filters of semi-implicit solvers.
#pragma once

#include "lang/calculus/diffusion.h"
#include "lang/lower/step_plan.h"
#include "solvers/step_problem.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// Factors that stay as they are are found once, those that change in every step.
class BoundDiffusion {
public:
    /// Each formula's largest value over the cells at the present state.
    using Largest = std::function<std::vector<double>(std::span<const Formula* const>)>;

    BoundDiffusion(const Program& program, std::uint32_t stage, const Largest& largest);

    /// The passes that come before those of a step: they write the changing factors to temporary
    /// planes. Without passes where there are none.
    const StepPlan& before() const { return before_; }

    /// Adds the factors to a problem that begins with the passes of before(): planes are reduced to
    /// their largest values after those.
    void add_to(StepProblem& problem) const;

private:
    std::vector<DiffusionTerms<StepProblem::DiffusionFactor>> factors_;
    StepPlan before_;
    std::vector<std::uint32_t> planes_;  ///< Temporary of each changing factor.
};

}  // namespace cascade
