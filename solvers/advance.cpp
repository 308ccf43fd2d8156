// The time loop of one stage.
#include "solvers/advance.h"

#include "core/check.h"
#include "solvers/finite.h"
#include "solvers/pace.h"
#include "solvers/stepper.h"
#include "solvers/thread_tuner.h"
#include "solvers/tile_tuner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <type_traits>
#include <utility>

namespace cascade {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// The first species, and in it the first cell, that is not finite.
std::optional<NotFinite> find_not_finite(const std::vector<Field>& species, std::int64_t step,
                                         std::int64_t last_finite) {
    for (std::size_t k = 0; k < species.size(); ++k) {
        if (const auto place = first_not_finite(species[k])) {
            return NotFinite{k, place->column, place->row, step, last_finite};
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
          stepper_(problem, std::move(species), schedule.threads,
                   keeps_copy(schedule, problem.species_needs_halo.size(), problem.grid,
                              problem.precision)),
          progress_(std::move(progress)),
          pace_(Clock::now(), schedule.first_step),
          thread_tuner_(stepper_.most_threads()),
          tile_tuner_(tuner_of(tilings_to_try())),
          time_(schedule.time),
          control_of_steps_(schedule.time.control, schedule.error_order),
          plain_(&problem),
          judged_(schedule.judged != nullptr ? schedule.judged : &problem),
          step_(schedule.first_step),
          last_look_(schedule.first_step),
          began_(Clock::now()) {
        progress_.steps = std::max(progress_.steps, schedule.last_step);
        if (has_end_time()) progress_.duration = schedule.end_time;
        tenths_seen_ = tenths_reached(now(), schedule.end_time);
        stepper_.set_clock(time_.clock);
    }

    StageOutcome run() {
        report(Clock::now(), false);
        outcome_.ended = is_over();
        if (step_ == 0 && !outcome_.ended) choose();
        bool going_on = true;
        while (going_on && !outcome_.ended && step_ < schedule_.last_step && !control_.cancel) {
            going_on = batch();
        }
        outcome_.cancelled = going_on && !outcome_.ended && step_ < schedule_.last_step;
        if (outcome_.cancelled && !stepper_.is_finite()) replay();
        outcome_.steps = step_;
        outcome_.t = now();
        outcome_.threads = thread_tuner_.threads();
        outcome_.stepping = stepper_.stepping();
        if (const std::string how = tile_tuner_.how_found(); !how.empty())
            outcome_.stepping.why = how;
        time_.control = control_of_steps_.state();
        outcome_.time = time_;
        species_ = std::move(stepper_.current());
        report(Clock::now(), true);
        return std::move(outcome_);
    }

private:
    bool is_judging() const { return schedule_.tolerance > 0; }
    /// Is the error of the next step estimated?
    bool judges_next() const {
        // What is left of the stage may be shorter than a step, and its last step is judged.
        return is_judging() && (step_ + 1 >= time_.next_judged || whole_steps_left() <= 1);
    }
    bool has_end_time() const { return std::isfinite(schedule_.end_time); }
    double now() const { return time_.clock.at(step_); }

    /// Takes some steps and does what is due after them; false ends the loop.
    bool batch() {
        const std::int64_t stop = next_stop();
        stepper_.use_threads(thread_tuner_.threads());
        stepper_.use_tiling(tile_tuner_.tiling());
        const std::int64_t count = std::min(steps_of_batch(), stop - step_);
        const bool is_kept = schedule_.keep_is_due && schedule_.keep_is_due();
        const bool look = step_ + count == stop || is_kept;
        // What is best for interpreted steps, or for some of either kind, is no matter.
        const bool is_good_measure =
            !stepper_.problem().is_provisional() && !tile_tuner_.is_trying();
        const Clock::time_point before = Clock::now();
        const bool good = judges_next() ? take_judged_step() : take_steps(count, look);
        const Clock::time_point after = Clock::now();
        pace_.took(count, after - before);
        if (is_good_measure) thread_tuner_.took(count, after - before);
        if (!good) return false;
        if (pace_.report_due(after)) report(after, false);
        if (look && !do_what_is_due()) return false;
        if (is_kept && !outcome_.ended) keep();
        return true;
    }

    std::int64_t steps_of_batch() const {
        const std::int64_t steps = pace_.batch(stepper_.steps_at_once());
        if (!tile_tuner_.is_trying()) return steps;
        const std::int64_t sweeps = sweeps_of_step();
        return std::min(steps, (tile_tuner_.sweeps_of_trial() + sweeps - 1) / sweeps);
    }
    std::int64_t sweeps_of_step() const {
        return static_cast<std::int64_t>(stepper_.problem().passes.size());
    }

    /// How long the steps ahead will take; where nobody knows their number, as long as those
    /// before.
    Seconds time_left(Seconds of_step) const {
        if (schedule_.check > 0) return Clock::now() - began_;
        const auto by_number = static_cast<double>(schedule_.last_step - step_);
        return of_step * std::min(by_number, (schedule_.end_time - now()) / time_.clock.step);
    }

    std::vector<Tiling> tilings_to_try() const {
        return schedule_.tiling ? std::vector{*schedule_.tiling} : stepper_.tilings_to_try();
    }
    TileTuner tuner_of(std::vector<Tiling> tilings) const {
        return TileTuner(std::move(tilings), schedule_.tilings, stepper_.most_threads());
    }

    /// Steps of one length.
    bool take_steps(std::int64_t count, bool look) {
        use_plain();
        const bool is_native = !stepper_.problem().is_provisional();
        // What is tried is how steps are taken, not how they are looked at, and on one number of
        // threads.
        const bool is_trial = tile_tuner_.is_trying();
        const Clock::time_point before = Clock::now();
        bool finite = stepper_.advance(step_, count, look && !is_trial);
        const Seconds duration = Clock::now() - before;
        step_ += count;
        if (is_native && !thread_tuner_.is_trying()) {
            const Seconds of_step = duration / static_cast<double>(count);
            tile_tuner_.took(count * sweeps_of_step(), duration, time_left(of_step));
        }
        if (look && is_trial) finite = stepper_.is_finite();
        if (!finite) {
            replay();
            return false;
        }
        if (look) {
            stepper_.keep();
            last_look_ = step_;
        }
        return true;
    }

    /// What a look is for besides finding values that are not finite; false ends the loop.
    bool do_what_is_due() {
        outcome_.ended = is_over();
        if (schedule_.onlooker) {
            lend([&] { return schedule_.onlooker(step_, now(), species_), true; });
        }
        if (observation_due() && !lend([&] { return observe_(step_, now(), species_); }))
            return false;
        if (schedule_.check > 0 && step_ % schedule_.check == 0 &&
            lend([&] { return schedule_.ends(step_, now(), species_); })) {
            outcome_.ended = true;
            progress_.condition_met = true;
        }
        const bool is_due = schedule_.choose_every > 0 && step_ % schedule_.choose_every == 0;
        if (is_due && !outcome_.ended && !is_judging()) choose();
        return true;
    }

    /// The next step after which values are looked at: no picture is made of values that are not
    /// finite, no stage ends with them, and steps change their length only there, so that those
    /// since the last look can be taken again.
    std::int64_t next_stop() {
        if (judges_next()) return step_ + 1;
        std::int64_t stop = last_look_ + schedule_.check_every;
        for (const std::int64_t of :
             {schedule_.interval, schedule_.check, schedule_.choose_every}) {
            if (of > 0) stop = std::min(stop, next_multiple(step_, of));
        }
        stop = std::min(stop, schedule_.last_step);
        if (is_judging()) stop = std::min(stop, time_.next_judged - 1);
        if (!has_end_time()) return stop;
        if (looks_at_tenths()) {
            stop =
                std::min(stop, step_ + steps_until((tenths_seen_ + 1) * schedule_.end_time / 10));
        }
        if (const std::int64_t whole = whole_steps_left(); whole > 0) {
            return std::min(stop, step_ + (is_judging() ? whole - 1 : whole));
        }
        // What is left is shorter than a step.
        set_step(schedule_.end_time - now());
        return step_ + 1;
    }

    /// Whole steps that fit into the time that is left, of which rounding may have taken some.
    std::int64_t whole_steps_left() const {
        if (!has_end_time()) return std::numeric_limits<std::int64_t>::max();
        const double steps = (schedule_.end_time - now()) / time_.clock.step;
        return static_cast<std::int64_t>(std::min(std::floor(steps + rounding_of_time), 1e18));
    }
    /// The steps after which t has come so far; at least one.
    std::int64_t steps_until(double t) const {
        const double steps = std::ceil((t - now()) / time_.clock.step - rounding_of_time);
        return static_cast<std::int64_t>(std::clamp(steps, 1.0, 1e9));
    }
    bool is_over() const {
        return schedule_.end_time - now() <= rounding_of_time * time_.clock.step;
    }
    bool looks_at_tenths() const { return schedule_.tenths || schedule_.interval == 0; }

    void set_step(double length) {
        time_.clock.set_step(step_, length);
        stepper_.set_clock(time_.clock);
    }

    double wanted_step() const {
        const double wanted = std::min(control_of_steps_.step(), schedule_.largest_step);
        return schedule_.longest_step ? std::min(wanted, schedule_.longest_step(now())) : wanted;
    }

    /// Lets the caller choose how long the next steps are.
    void choose(bool rejected = false) {
        if (!schedule_.choose) return;
        const StepChoice choice = lend([&] { return schedule_.choose(step_, time_, rejected); });
        plain_ = choice.problem;
        judged_ = choice.judged;
        set_step(choice.step);
    }

    /// What was found about tilings stays where the new passes have the same ones to choose from.
    void use_plain() {
        if (plain_ == &stepper_.problem()) return;
        stepper_.use(*plain_);
        auto tilings = tilings_to_try();
        if (tilings != tile_tuner_.candidates()) tile_tuner_ = tuner_of(std::move(tilings));
    }

    bool observation_due() {
        if (!observe_) return false;
        const bool is_multiple = schedule_.interval > 0 && step_ % schedule_.interval == 0;
        if (!looks_at_tenths()) return is_multiple;
        const double seen = tenths_reached(now(), schedule_.end_time);
        const bool due = is_multiple || seen > tenths_seen_;
        tenths_seen_ = seen;
        return due;
    }

    /// The caller's vector holds the species while he looks at it.
    template <typename Look>
    std::invoke_result_t<Look> lend(Look look) {
        species_ = std::move(stepper_.current());
        auto answer = look();
        stepper_.current() = std::move(species_);
        return answer;
    }

    /// Hands over what steps go on from.
    void keep() {
        TimeState time = time_;
        time.control = control_of_steps_.state();
        lend([&] {
            schedule_.keep(step_, now(), time);
            return true;
        });
    }

    /// Tries steps until one's error is small enough; those before are as if they had not been.
    /// False where steps have become too short.
    bool take_judged_step() {
        const double t = now(), left = schedule_.end_time - t;
        if (!schedule_.choose) set_step(wanted_step());
        while (true) {
            // A last step that would leave a crumb is made a little longer.
            const double length = left < 1.01 * time_.clock.step ? left : time_.clock.step;
            set_step(length);
            stepper_.use(*judged_);
            const CopyRoles before = stepper_.roles();
            const double error = stepper_.attempt(step_, schedule_.tolerance);
            if (control_of_steps_.judge(length, error)) break;
            if (length <= time_.least_step) {
                if (std::isfinite(error)) break;
                return fail_after(before);
            }
            if (control_of_steps_.step() < least_step(t)) {
                outcome_.too_short = where_error_is_largest(t);
                stepper_.undo(before);
                return false;
            }
            stepper_.undo(before);
            if (schedule_.choose) {
                time_.control = control_of_steps_.state();
                choose(true);
            } else {
                set_step(wanted_step());
            }
        }
        ++step_;
        time_.clock.begin_at(step_);
        stepper_.set_clock(time_.clock);
        stepper_.accept();
        stepper_.keep();
        last_look_ = step_;
        time_.control = control_of_steps_.state();
        if (!is_over()) choose();
        return true;
    }

    /// Goes back to before the step just tried, which spoiled a value. `last_checked` gets the
    /// state then.
    bool fail_after(CopyRoles before) {
        outcome_.not_finite = find_not_finite(stepper_.current(), step_ + 1, step_);
        stepper_.undo(before);
        // Where the values are finite, their rates are not.
        if (!outcome_.not_finite) {
            outcome_.too_short = where_error_is_largest(now());
            return false;
        }
        for (const Field& field : stepper_.current())
            outcome_.last_checked.push_back(field.clone());
        return false;
    }

    /// Shorter steps would not end in anybody's lifetime.
    double least_step(double t) const {
        return 1e-10 * (has_end_time() ? schedule_.end_time : std::max(t, 1.0));
    }

    StepTooShort where_error_is_largest(double t) const {
        StepTooShort place;
        place.t = t;
        place.step = control_of_steps_.step();
        double most = -1;
        const std::vector<Field>& errors = stepper_.error_planes();
        const auto look = [&](std::size_t k, const auto& plane) {
            const PlaneLayout& layout = plane.layout();
            for (std::int64_t row = 0; row < layout.row_count(); ++row) {
                for (std::int64_t i = 0; i < layout.width; ++i) {
                    // What is not a number is larger than any.
                    const double size = std::abs(double{plane.row(row)[i]});
                    if (std::isnan(most) || size <= most) continue;
                    most = size;
                    place.species = k;
                    place.column = i;
                    place.row = row;
                }
            }
        };
        for (std::size_t k = 0; k < errors.size(); ++k) {
            errors[k].visit([&](const auto& plane) { look(k, plane); });
        }
        return place;
    }

    /// Goes back to the kept copy and takes the same steps again, one by one, up to the one that
    /// spoils a value; stops before it. The steps are the same bits, so that one is met. Where
    /// nothing is kept the spoiled values have to do.
    void replay() {
        if (!stepper_.keeps()) {
            outcome_.not_finite = find_not_finite(stepper_.current(), step_, last_look_);
            return;
        }
        outcome_.last_checked.reserve(stepper_.kept().size());
        for (const Field& field : stepper_.kept()) {
            outcome_.last_checked.push_back(field.clone());
        }
        const std::int64_t spoiled = step_;
        stepper_.back();
        for (step_ = last_look_; step_ < spoiled; ++step_) {
            const CopyRoles before = stepper_.roles();
            if (stepper_.advance(step_, 1, true)) continue;
            outcome_.not_finite = find_not_finite(stepper_.current(), step_ + 1, step_);
            stepper_.undo(before);
            return;
        }
        CHECK(false, "a replay takes the same steps");
    }

    void report(Clock::time_point moment, bool done) {
        pace_.reported(moment, step_);
        if (!control_.report) return;
        progress_.step = step_;
        progress_.t = now();
        progress_.steps_per_second = pace_.steps_per_second();
        const double left = has_end_time() ? (schedule_.end_time - now()) / time_.clock.step
                                           : static_cast<double>(schedule_.last_step - step_);
        progress_.seconds_left =
            progress_.steps_per_second > 0 ? left / progress_.steps_per_second : -1;
        progress_.stage_done = done;
        control_.report(progress_);
    }

    /// Parts of a step by which sums of time may be wrong.
    static constexpr double rounding_of_time = 1e-6;

    const Schedule& schedule_;
    RunControl& control_;
    const Observer& observe_;
    std::vector<Field>& species_;
    Stepper stepper_;
    Progress progress_;
    Pace pace_;
    ThreadTuner thread_tuner_;
    TileTuner tile_tuner_;
    TimeState time_;
    StepControl control_of_steps_;
    const StepProblem* plain_;   ///< The sweeps of steps whose error is not estimated,
    const StepProblem* judged_;  ///< and of those whose error is.
    std::int64_t step_;
    std::int64_t last_look_;
    Clock::time_point began_;
    double tenths_seen_ = 0;
    StageOutcome outcome_;
};

}  // namespace

double tenths_reached(double t, double end_time) {
    return std::isfinite(end_time) ? std::floor(10 * t / end_time + 1e-9) : 0;
}

bool keeps_copy(const Schedule& schedule, std::size_t species, const Grid& grid,
                Precision precision) {
    // A step whose error was estimated can be taken back without one.
    if (schedule.judges_all) return false;
    const auto bytes = PlaneLayout(grid).size() * static_cast<std::int64_t>(bytes_of(precision));
    return bytes * static_cast<std::int64_t>(species) <= schedule.most_kept_bytes;
}

StageOutcome advance(const StepProblem& problem, const Schedule& schedule,
                     std::vector<Field>& species, RunControl& control, Progress progress,
                     const Observer& observe) {
    CHECK(!problem.passes.empty(), "a step has a pass");
    CHECK(schedule.check_every > 0, "steps between two looks");
    if (auto found = find_not_finite(species, schedule.first_step, schedule.first_step)) {
        StageOutcome outcome;
        outcome.steps = schedule.first_step;
        outcome.not_finite = found;
        return outcome;
    }
    return TimeLoop(problem, schedule, species, control, std::move(progress), observe).run();
}

}  // namespace cascade
