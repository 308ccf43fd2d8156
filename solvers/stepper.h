// Takes steps. An executor runs their passes over copies of the species, which are swapped. The
// time loop decides the number of steps and when to check values.
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
    /// Makes `species` the current copy and, if `keeps` is true, the kept copy. Fills its halo.
    /// Begins with `most_threads` threads, or with fewer on small grids.
    Stepper(const StepProblem& problem, std::vector<Field> species, int most_threads,
            bool keeps = true, const MakeExecutor& make = make_thread_executor);

    Executor& executor() { return *executor_; }
    const Executor& executor() const { return *executor_; }

    CopyRoles roles() const { return roles_; }
    /// Gives the copies the roles that they had at an earlier moment, which undoes the steps since
    /// then.
    void set_roles(CopyRoles roles) { roles_ = roles; }
    /// Makes the current copy the kept copy. Does nothing if this stepper has no kept copy.
    void keep() { roles_.keep(); }
    /// Makes the kept copy current.
    void back();

    /// The current values, which may be read until the next step.
    const std::vector<Field>& species() const { return executor_->fetch(roles_.current); }
    /// Moves the current values to the caller's vector. The caller must give them back by
    /// take_back() before the next step.
    void lend(std::vector<Field>& to) { to = executor_->take(roles_.current); }
    void take_back(std::vector<Field>& from) { executor_->put(roles_.current, std::move(from)); }
    /// The planes of a scratch register, which may be read until the next step.
    const std::vector<Field>& scratch(RegisterId id) const { return executor_->fetch(id); }
    /// The error estimate: one plane per species.
    const std::vector<Field>& error_planes() const { return scratch(*problem().error_register); }

    /// The problem whose passes are in use.
    const StepProblem& problem() const { return executor_->problem(); }
    /// Uses the passes of another problem from now on. The problem must outlive its use.
    void use(const StepProblem& problem);
    /// Sets the time and the length of all later steps.
    void set_clock(const StageClock& clock) { clock_ = clock; }
    /// From now on, steps stop when `cancel` becomes true: attempt(), and advance() with a `count`
    /// of 1, abandon their work and leave the current values unchanged. With a larger `count`,
    /// whose steps are short, all steps are completed.
    void leave_on(const std::atomic<bool>& cancel) { cancel_ = &cancel; }

    /// Takes `count` steps, at least one, after `complete` earlier ones. If `look` is true, returns
    /// whether all new values are finite, otherwise returns true.
    bool advance(std::int64_t complete, std::int64_t count, bool look);
    /// Whether all current values are finite.
    bool is_finite() { return executor_->is_finite(roles_.current); }

    /// Tries one step of a problem with an error register. Returns the error of the step in units
    /// of the tolerance. For each species, the root mean square of the error is divided by the root
    /// mean square of the new values and by `tolerance`. The error of the step is the largest of
    /// these quotients. NaN if an error or a new value is not finite. The caller must then call
    /// accept(), or undo the step by set_roles() with the earlier roles.
    double attempt(std::int64_t complete, double tolerance);
    /// Accepts the step just tried. Its last rates become the first rates of the next step.
    void accept();
    /// Scheme::curve of the step accepted last: Σ factor · rate, by species. Empty if the method
    /// has no such term. Must be called before the next step.
    std::vector<Field> curve() const;
    /// Must be called when current values have been changed from outside.
    void forget_rates() { knows_first_rates_ = false; }
    /// Continues with the same values at a later moment, after rates or sides have jumped. Fills
    /// the halo for that moment.
    void pass_jump(SideMoment moment);

private:
    std::unique_ptr<Executor> executor_;
    CopyRoles roles_;
    StageClock clock_;
    const std::atomic<bool>* cancel_ = nullptr;
    /// Whether the register of first rates holds the rates at the current copy.
    bool knows_first_rates_ = false;
};

/// Lends the current species to the caller's vector during the lifetime of this object.
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
