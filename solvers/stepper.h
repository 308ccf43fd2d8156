// Takes steps: an executor runs their passes over copies of the species that are swapped. Used by
// the time loop, which decides the number of steps and when to check values.
#pragma once

#include "core/plane.h"
#include "solvers/executor.h"
#include "solvers/stage_clock.h"
#include "solvers/step_problem.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace cascade {

class Stepper {
public:
    /// Takes `species` as current, and as kept unless `keeps` is false; fills their halo. At first
    /// all threads are in use; `most_threads` is lowered to what the grid is worth.
    Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
            bool keeps = true, const MakeExecutor& make = make_thread_executor);

    Executor& executor() { return *executor_; }
    const Executor& executor() const { return *executor_; }

    CopyRoles roles() const { return roles_; }
    /// To undo a step.
    void set_roles(CopyRoles roles) { roles_ = roles; }
    /// Makes the current copy the kept one, if one is kept.
    void keep() { roles_.keep(); }
    /// Goes back to the kept copy.
    void back();

    /// The current values, which may be read until the next step.
    const std::vector<Field>& species() const { return executor_->fetch(roles_.current); }
    /// Lends them to the caller's vector; they must come back before the next step.
    void lend(std::vector<Field>& to) { to = executor_->take(roles_.current); }
    void take_back(std::vector<Field>& from) { executor_->put(roles_.current, std::move(from)); }
    /// The planes of a scratch register, which may be read until the next step.
    const std::vector<Field>& scratch(RegisterId id) const { return executor_->fetch(id); }
    /// The error estimate: one plane per species.
    const std::vector<Field>& error_planes() const { return scratch(*problem().error_register); }

    /// The passes in use.
    const StepProblem& problem() const { return executor_->problem(); }
    /// Uses the passes of another problem from now on. It must outlive its use.
    void use(const StepProblem& problem);
    /// Sets time and length of the steps from now on.
    void set_clock(const StageClock& clock) { clock_ = clock; }
    /// From now on, when `cancel` becomes true, a step that is taken by itself is left undone:
    /// advance() and attempt() abandon their work, and the current values are as before. Several
    /// steps taken at once, which are short, are completed.
    void leave_on(const std::atomic<bool>& cancel) { cancel_ = &cancel; }

    /// Takes `count` steps, at least one, after `complete` earlier ones. With `look`, returns
    /// whether the new values are all finite; without it, true.
    bool advance(std::int64_t complete, std::int64_t count, bool look);
    /// Are all current values finite?
    bool is_finite() { return executor_->is_finite(roles_.current); }

    /// Tries one step of a problem with an error register and returns its error in units of the
    /// tolerance: for each species the root mean square of the error, divided by that of its new
    /// values and by `tolerance`; the largest of them; NaN if an error or a new value is not
    /// finite. Then call accept(), or undo the step by giving the planes their former roles.
    double attempt(std::int64_t complete, double tolerance);
    /// Accepts the step just tried: its last rates become the first rates of the next step.
    void accept();
    /// Must be called when current values have been changed from outside.
    void forget_rates() { knows_first_rates_ = false; }
    /// Goes on at a later moment with the same values: fills their halo for it.
    void pass_jump(SideMoment moment);

private:
    std::unique_ptr<Executor> executor_;
    CopyRoles roles_;
    StageClock clock_;
    const std::atomic<bool>* cancel_ = nullptr;
    /// The register of first rates holds the rates of the current copy.
    bool knows_first_rates_ = false;
};

/// Lends the current species to the caller's vector while it exists.
class SpeciesLoan {
public:
    SpeciesLoan(Stepper& stepper, std::vector<Field>& to) : stepper_(stepper), to_(to) {
        stepper_.lend(to_);
    }
    ~SpeciesLoan() { stepper_.take_back(to_); }
    SpeciesLoan(const SpeciesLoan&) = delete;
    SpeciesLoan& operator=(const SpeciesLoan&) = delete;

private:
    Stepper& stepper_;
    std::vector<Field>& to_;
};

}  // namespace cascade
