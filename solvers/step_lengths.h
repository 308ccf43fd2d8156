// Chooses the length of steps. Either the caller chooses it from the present values, or a step is
// repeated with shorter lengths until its error is small enough.
#pragma once

#include "solvers/advance.h"
#include "solvers/loop_clock.h"
#include "solvers/step_control.h"
#include "solvers/stepper.h"

#include <vector>

namespace cascade {

class StepLengths {
public:
    /// `problem` holds the passes of the first steps. `species` receives the values while the
    /// caller chooses. All arguments must outlive the object.
    StepLengths(const Schedule& schedule, const StepProblem& problem, LoopClock& clock,
                Stepper& stepper, std::vector<Field>& species);

    /// The passes of steps without an estimated error.
    const StepProblem& plain() const { return *plain_; }
    /// The time, and the state of the controller, from which steps continue.
    TimeState time() const;

    /// Lets the caller choose the length of the next steps. `rejected` says that the length chosen
    /// last was too long.
    void choose(bool rejected = false);
    /// Tries shorter and shorter steps until the error of one is small enough, and takes that step.
    /// Rejected steps change no values. Returns false, with the reason in `outcome`, if steps have
    /// become too short.
    bool take_judged_step(StageOutcome& outcome);

private:
    void pass_jump();
    double wanted_step() const;
    double least_step() const;
    bool fail_after(CopyRoles before, StageOutcome& outcome);
    StepTooShort where_error_is_largest() const;

    const Schedule& schedule_;
    LoopClock& clock_;
    Stepper& stepper_;
    std::vector<Field>& species_;
    StepControl control_;
    const StepProblem* plain_;   ///< The passes of steps without an estimated error.
    const StepProblem* judged_;  ///< The passes of steps with an estimated error.
};

}  // namespace cascade
