// The diffusion of a stage's species, prepared for the filters of semi-implicit solvers.
#pragma once

#include "lang/calculus/diffusion.h"
#include "lang/lower/step_plan.h"
#include "solvers/step_problem.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// Constant factors are computed once, the others in every step.
class BoundDiffusion {
public:
    /// Returns the largest value of each formula over the cells at the present state.
    using Largest = std::function<std::vector<double>(std::span<const Formula* const>)>;

    BoundDiffusion(const Program& program, std::uint32_t stage, const Largest& largest);

    /// The passes that precede those of a step and write the changing factors to temporary planes.
    /// There are none if no factor changes.
    const StepPlan& before() const { return before_; }

    /// Adds the factors to a problem that begins with the passes of before(); after those, the
    /// planes are reduced to their largest values.
    void add_to(StepProblem& problem) const;

private:
    std::vector<DiffusionTerms<StepProblem::DiffusionFactor>> factors_;
    StepPlan before_;
    std::vector<TemporaryId> planes_;  ///< The temporary of each changing factor.
};

}  // namespace cascade
