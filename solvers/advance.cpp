// The time loop of one stage.
#include "solvers/advance.h"

#include "core/check.h"
#include "solvers/finite.h"
#include "solvers/pace.h"
#include "solvers/stepper.h"
#include "solvers/thread_tuner.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cascade {
namespace {

using Clock = std::chrono::steady_clock;

/// The first species, and in it the first cell, that is not finite.
std::optional<NotFinite> find_not_finite(const std::vector<Field>& species, std::int64_t step) {
    for (std::size_t k = 0; k < species.size(); ++k) {
        if (const auto place = first_not_finite(species[k])) {
            return NotFinite{k, place->column, place->row, step};
        }
    }
    return std::nullopt;
}

std::int64_t next_multiple(std::int64_t step, std::int64_t of) { return (step / of + 1) * of; }

/// One call of advance().
class TimeLoop {
public:
    TimeLoop(const StepProblem& problem, const Schedule& schedule, std::vector<Field>& species,
             RunControl& control, Progress progress, const Observer& observe)
        : schedule_(schedule),
          control_(control),
          observe_(observe),
          species_(species),
          stepper_(problem, std::move(species), schedule.threads),
          progress_(std::move(progress)),
          pace_(Clock::now(), schedule.first_step),
          tuner_(stepper_.most_threads()),
          step_(schedule.first_step),
          kept_step_(schedule.first_step) {
        progress_.steps = std::max(progress_.steps, schedule.last_step);
    }

    StageOutcome run() {
        report(Clock::now(), false);
        bool going_on = true;
        while (going_on && step_ < schedule_.last_step && !control_.cancel) going_on = batch();
        outcome_.cancelled = going_on && step_ < schedule_.last_step;
        if (outcome_.cancelled && !stepper_.is_finite()) replay();
        outcome_.steps = step_;
        species_ = std::move(stepper_.current());
        report(Clock::now(), true);
        return std::move(outcome_);
    }

private:
    /// Takes some steps and does what is due behind them; false ends the loop.
    bool batch() {
        const std::int64_t stop = next_stop();
        const std::int64_t count = std::min(pace_.batch(), stop - step_);
        const bool look = step_ + count == stop;
        stepper_.use_threads(tuner_.threads());
        const Clock::time_point before = Clock::now();
        const bool finite = stepper_.advance(step_, count, look);
        const Clock::time_point after = Clock::now();
        pace_.took(count, after - before);
        tuner_.took(count, after - before);
        step_ += count;
        if (!finite) {
            replay();
            return false;
        }
        if (look) {
            stepper_.keep();
            kept_step_ = step_;
        }
        if (pace_.report_due(after)) report(after, false);
        return !observation_due() || observe();
    }

    /// The next step behind which values are looked at: no picture is made of values that are not
    /// finite, and no stage ends with them.
    std::int64_t next_stop() const {
        std::int64_t stop = std::min(kept_step_ + schedule_.check_every, schedule_.last_step);
        if (schedule_.interval > 0) stop = std::min(stop, next_multiple(step_, schedule_.interval));
        return stop;
    }

    bool observation_due() const {
        return observe_ && schedule_.interval > 0 && step_ % schedule_.interval == 0;
    }

    /// The caller's vector holds the species while he looks at it.
    bool observe() {
        species_ = std::move(stepper_.current());
        const bool going_on = observe_(step_, species_);
        stepper_.current() = std::move(species_);
        return going_on;
    }

    /// Goes back to the kept copy and takes the same steps again, one by one, up to the one that
    /// spoils a value; stops before it. The steps are the same bits, so that one is met.
    void replay() {
        outcome_.last_checked.reserve(stepper_.kept().size());
        for (const Field& field : stepper_.kept()) {
            outcome_.last_checked.push_back(field.clone());
        }
        const std::int64_t spoiled = step_;
        stepper_.back();
        for (step_ = kept_step_; step_ < spoiled; ++step_) {
            const CopyRoles before = stepper_.roles();
            if (stepper_.advance(step_, 1, true)) continue;
            outcome_.not_finite = find_not_finite(stepper_.current(), step_ + 1);
            stepper_.undo(before);
            return;
        }
        CHECK(false, "a replay takes the same steps");
    }

    void report(Clock::time_point now, bool done) {
        pace_.reported(now, step_);
        if (!control_.report) return;
        progress_.step = step_;
        progress_.steps_per_second = pace_.steps_per_second();
        progress_.seconds_left =
            progress_.steps_per_second > 0
                ? static_cast<double>(schedule_.last_step - step_) / progress_.steps_per_second
                : -1;
        progress_.stage_done = done;
        control_.report(progress_);
    }

    const Schedule& schedule_;
    RunControl& control_;
    const Observer& observe_;
    std::vector<Field>& species_;
    Stepper stepper_;
    Progress progress_;
    Pace pace_;
    ThreadTuner tuner_;
    std::int64_t step_;
    std::int64_t kept_step_;
    StageOutcome outcome_;
};

}  // namespace

StageOutcome advance(const StepProblem& problem, const Schedule& schedule,
                     std::vector<Field>& species, RunControl& control, Progress progress,
                     const Observer& observe) {
    CHECK(schedule.check_every > 0, "steps between two looks");
    if (auto found = find_not_finite(species, schedule.first_step)) {
        StageOutcome outcome;
        outcome.steps = schedule.first_step;
        outcome.not_finite = found;
        return outcome;
    }
    return TimeLoop(problem, schedule, species, control, std::move(progress), observe).run();
}

}  // namespace cascade
