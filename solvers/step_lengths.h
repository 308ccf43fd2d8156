// How long steps are: chosen by the caller from the present values, or by the error of a step,
// which is tried until that is small enough.
#pragma once

#include "solvers/advance.h"
#include "solvers/loop_clock.h"
#include "solvers/step_control.h"
#include "solvers/stepper.h"

#include <vector>

namespace cascade {

class StepLengths {
public:
    /// `problem` are the passes of the first steps; `species` is lent the values while the caller
    /// chooses. All must outlive it.
    StepLengths(const Schedule& schedule, const StepProblem& problem, LoopClock& clock,
                Stepper& stepper, std::vector<Field>& species);

    /// The passes of steps whose error is not estimated.
    const StepProblem& plain() const { return *plain_; }
    /// What steps go on from.
    TimeState time() const;

    /// Lets the caller choose how long the next steps are.
    void choose(bool rejected = false);
    /// Tries steps until one's error is small enough; those before are as if they had not been.
    /// False, with the reason in `outcome`, where steps have become too short.
    bool take_judged_step(StageOutcome& outcome);

private:
    double wanted_step() const;
    double least_step() const;
    bool fail_after(CopyRoles before, StageOutcome& outcome);
    StepTooShort where_error_is_largest() const;

    const Schedule& schedule_;
    LoopClock& clock_;
    Stepper& stepper_;
    std::vector<Field>& species_;
    StepControl control_;
    const StepProblem* plain_;   ///< The passes of steps whose error is not estimated,
    const StepProblem* judged_;  ///< and of those whose error is.
};

}  // namespace cascade
