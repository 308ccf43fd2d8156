// The time loop of one stage.
#include "solvers/advance.h"

#include "core/check.h"
#include "solvers/batch_tuner.h"
#include "solvers/loop_clock.h"
#include "solvers/spoiled_step.h"
#include "solvers/step_lengths.h"
#include "solvers/stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {

bool keeps_copy(const Schedule& schedule, std::size_t species, const Grid& grid,
                Precision precision) {
    // If the error of every step is estimated, a step can be undone without a stored copy.
    if (schedule.judges_all) return false;
    const auto bytes = PlaneLayout(grid).size() * static_cast<std::int64_t>(bytes_of(precision));
    return bytes * static_cast<std::int64_t>(species) <= schedule.most_kept_bytes;
}

class TimeLoop::Implementation {
public:
    Implementation(const StepProblem& problem, Schedule schedule, std::vector<Field>& species,
                   Progress progress)
        : schedule_(std::move(schedule)),
          species_(species),
          stepper_(problem, std::move(species), schedule_.threads,
                   keeps_copy(schedule_, problem.species_needs_halo.size(), problem.grid,
                              problem.precision),
                   schedule_.executor),
          clock_(schedule_),
          lengths_(schedule_, problem, clock_, stepper_, species_),
          tuner_(schedule_, clock_, stepper_),
          progress_(std::move(progress)),
          steps_of_stage_(progress_.steps) {
        CHECK(schedule_.check_every > 0, "steps between two looks");
        if (clock_.has_end_time()) progress_.duration = schedule_.end_time;
        stepper_.lend(species_);
    }

    StageOutcome advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                         const Observer& observe) {
        outcome_ = {};
        stepper_.take_back(species_);
        if (!is_known_to_be_finite_ && !stepper_.is_finite()) {
            stepper_.lend(species_);
            outcome_.not_finite = find_not_finite(species_, clock_.step, clock_.step);
            outcome_.steps = clock_.step;
            return std::move(outcome_);
        }
        is_known_to_be_finite_ = true;
        schedule_.last_step = last_step;
        schedule_.planned_step =
            control.checks_later ? std::max(last_step, steps_of_stage_) : last_step;
        schedule_.interval = interval;
        progress_.steps = std::max(steps_of_stage_, last_step);
        may_check_later_ =
            control.checks_later && last_step < steps_of_stage_ && stepper_.roles().keeps();
        clock_.go_on();
        tuner_.go_on();
        report(control, false);
        outcome_.ended = clock_.is_over();
        const bool begins = std::exchange(schedule_.begins_anew, false) || clock_.step == 0;
        if (begins && !outcome_.ended) lengths_.choose();
        bool going_on = true;
        stepper_.leave_on(control.cancel);
        // If a step is abandoned, the values of the last complete step remain.
        complete([&] {
            while (going_on && is_to_go_on() && !control.cancel) going_on = batch(control, observe);
        });
        outcome_.cancelled = going_on && is_to_go_on();
        if (going_on && !is_checked_ && (outcome_.cancelled || !may_check_later_)) check();
        outcome_.steps = clock_.step;
        outcome_.t = clock_.now();
        outcome_.threads = tuner_.threads();
        outcome_.time = lengths_.time();
        stepper_.lend(species_);
        report(control, true);
        return std::move(outcome_);
    }

    std::vector<Field> curve() const { return stepper_.curve(); }

    Stepping stepping() const { return tuner_.stepping(); }

private:
    bool is_to_go_on() const { return !outcome_.ended && clock_.step < schedule_.last_step; }

    /// Takes a batch of steps, then reports, checks and observes if that is due. Returns whether
    /// the loop goes on.
    bool batch(RunControl& control, const Observer& observe) {
        const std::int64_t next = clock_.next_check();
        const std::int64_t stop = std::min(next, schedule_.last_step);
        LoopDecision decision;
        decision.steps = tuner_.begin_batch(stop - clock_.step);
        decision.is_kept = schedule_.keep_is_due && schedule_.keep_is_due();
        const bool at_stop = clock_.step + decision.steps == stop;
        decision.is_looked_at =
            decision.is_kept || (at_stop && (stop == next || !may_check_later_));
        if (SharedSteps* const shared = stepper_.executor().shared_steps()) {
            decision = shared->agree(decision);
            if (control.cancel) return true;
        }
        const auto [count, look, is_kept] = decision;
        const bool good = clock_.judges_next() ? take_judged_step() : take_steps(count, look);
        const BatchTuner::Clock::time_point now = BatchTuner::Clock::now();
        tuner_.end_batch(count, now);
        if (!good) return false;
        if (tuner_.pace().report_due(now)) report(control, false);
        if (look && !do_what_is_due(observe)) return false;
        if (is_kept && !outcome_.ended) {
            const SpeciesLoan loan(stepper_, species_);
            if (schedule_.keep_is_due) {
                schedule_.keep(clock_.step, clock_.now(), lengths_.time());
            }
        }
        return true;
    }

    /// Takes a step and estimates its error. The estimate also finds spoiled values, because the
    /// error is not finite if a value is not.
    bool take_judged_step() {
        if (!tuner_.take_judged_step([this] { return lengths_.take_judged_step(outcome_); })) {
            return false;
        }
        found_finite();
        return true;
    }

    /// Takes steps of one length. If `look` is true, checks their values.
    bool take_steps(std::int64_t count, bool look) {
        if (!tuner_.take_steps(lengths_.plain(), count, look)) {
            find_spoiled_step();
            return false;
        }
        is_checked_ = false;
        if (look) found_finite();
        return true;
    }

    /// Checks the values of the steps since the last check.
    void check() {
        if (stepper_.is_finite()) {
            found_finite();
        } else {
            find_spoiled_step();
        }
    }

    void found_finite() {
        stepper_.keep();
        clock_.last_look = clock_.step;
        is_checked_ = true;
    }

    void find_spoiled_step() {
        clock_.step = replay(stepper_, clock_.last_look, clock_.step, outcome_);
    }

    /// Observes, tests whether the stage ends and chooses the next step length, each if that is
    /// due. The values must have been found finite. Returns whether the loop goes on.
    bool do_what_is_due(const Observer& observe) {
        const std::int64_t step = clock_.step;
        const double t = clock_.now();
        outcome_.ended = clock_.is_over();
        const bool asks_end = schedule_.check > 0 && step % schedule_.check == 0;
        {
            const SpeciesLoan loan(stepper_, species_);
            if (schedule_.onlooker) schedule_.onlooker(step, t, species_);
            if (clock_.observation_due() && observe && !observe(step, t, species_)) return false;
            if (asks_end && schedule_.ends(step, t, species_)) {
                outcome_.ended = true;
                progress_.condition_met = true;
            }
        }
        const bool is_due = schedule_.choose_every > 0 && step % schedule_.choose_every == 0;
        if (is_due && !outcome_.ended && !clock_.is_judging()) lengths_.choose();
        return true;
    }

    void report(RunControl& control, bool done) {
        tuner_.pace().reported(BatchTuner::Clock::now(), clock_.step);
        if (!control.report) return;
        progress_.step = clock_.step;
        progress_.t = clock_.now();
        progress_.steps_per_second = tuner_.pace().steps_per_second();
        progress_.seconds_left =
            progress_.steps_per_second > 0 ? clock_.steps_left() / progress_.steps_per_second : -1;
        progress_.stage_done = done;
        control.report(progress_);
    }

    Schedule schedule_;
    std::vector<Field>& species_;
    Stepper stepper_;
    LoopClock clock_;
    StepLengths lengths_;
    BatchTuner tuner_;
    Progress progress_;
    std::int64_t steps_of_stage_;
    /// Whether the starting values are known to be finite.
    bool is_known_to_be_finite_ = false;
    bool is_checked_ = true;  ///< Whether all values of the present step are known to be finite.
    /// Whether a later call may check the last step of the present call.
    bool may_check_later_ = false;
    StageOutcome outcome_;  ///< The outcome of the present call.
};

TimeLoop::TimeLoop(const StepProblem& problem, Schedule schedule, std::vector<Field>& species,
                   Progress progress)
    : self_(std::make_unique<Implementation>(problem, std::move(schedule), species,
                                             std::move(progress))) {}
TimeLoop::~TimeLoop() = default;

StageOutcome TimeLoop::advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                               const Observer& observe) {
    return self_->advance(last_step, interval, control, observe);
}

std::vector<Field> TimeLoop::curve() const { return self_->curve(); }

Stepping TimeLoop::stepping() const { return self_->stepping(); }

StageOutcome advance(const StepProblem& problem, const Schedule& schedule,
                     std::vector<Field>& species, RunControl& control, Progress progress,
                     const Observer& observe) {
    return TimeLoop(problem, schedule, species, std::move(progress))
        .advance(schedule.last_step, schedule.interval, control, observe);
}

}  // namespace cascade
