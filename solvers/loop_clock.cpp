// Finds the next stop from the schedule's intervals, marks, end time and the length of steps.
#include "solvers/loop_clock.h"

#include <algorithm>
#include <limits>

namespace cascade {
namespace {

/// The largest rounding error of a sum of times, in steps.
constexpr double rounding_of_time = 1e-6;

std::int64_t next_multiple(std::int64_t step, std::int64_t of) { return (step / of + 1) * of; }

}  // namespace

double marks_reached(double t, double end_time, double every) {
    // Allows for rounding errors in sums of times.
    if (every > 0) return std::floor(t / every * (1 + 1e-12));
    return std::isfinite(end_time) ? std::floor(10 * t / end_time + 1e-9) : 0;
}

double next_mark(double t, double every) {
    if (!(every > 0)) return std::numeric_limits<double>::infinity();
    return (marks_reached(t, 0, every) + 1) * every;
}

LoopClock::LoopClock(const Schedule& schedule)
    : step(schedule.first_step),
      last_look(schedule.first_step),
      time(schedule.time),
      schedule_(schedule) {}

void LoopClock::go_on() { marks_seen_ = marks_reached(now(), schedule_.end_time, schedule_.every); }

double LoopClock::next_end() const {
    return std::min(schedule_.end_time, next_mark(now(), schedule_.every));
}

bool LoopClock::is_over() const {
    return schedule_.end_time - now() <= rounding_of_time * time.clock.step;
}

double LoopClock::steps_left() const {
    return has_end_time() ? (schedule_.end_time - now()) / time.clock.step
                          : static_cast<double>(schedule_.last_step - step);
}

bool LoopClock::judges_next() const {
    // Errors are always estimated at the end of the stage, that is, when at most one whole step
    // fits into the remaining time.
    return is_judging() && (step + 1 >= time.next_judged || whole_steps_left() <= 1);
}

std::int64_t LoopClock::next_check() {
    // The last step may have been shortened to end at a mark.
    if (schedule_.every > 0 && schedule_.fixed_step > 0) set_step(schedule_.fixed_step);
    if (judges_next()) return step + 1;
    std::int64_t stop = last_look + schedule_.check_every;
    for (const std::int64_t of : {schedule_.interval, schedule_.check, schedule_.choose_every}) {
        if (of > 0) stop = std::min(stop, next_multiple(step, of));
    }
    if (is_judging()) stop = std::min(stop, time.next_judged - 1);
    if (schedule_.next_moment) stop = std::min(stop, step + steps_before_moment());
    if (has_end_time() && looks_at_marks() && !(schedule_.every > 0)) {
        stop = std::min(stop, step + steps_until((marks_seen_ + 1) * schedule_.end_time / 10));
    }
    const double end = next_end();
    if (!std::isfinite(end)) return stop;
    if (const std::int64_t whole = whole_steps_left(); whole > 0) {
        return std::min(stop, step + (is_judging() ? whole - 1 : whole));
    }
    set_step(end - now());
    return step + 1;
}

/// The number of whole steps that fit before the next end, up to rounding.
std::int64_t LoopClock::whole_steps_left() const {
    const double end = next_end();
    if (!std::isfinite(end)) return std::numeric_limits<std::int64_t>::max();
    const double steps = (end - now()) / time.clock.step;
    return static_cast<std::int64_t>(std::min(std::floor(steps + rounding_of_time), 1e18));
}

/// The number of whole steps before the next moment, at least one.
std::int64_t LoopClock::steps_before_moment() const {
    const double steps = (schedule_.next_moment(now()) - now()) / time.clock.step;
    return static_cast<std::int64_t>(std::clamp(std::floor(steps + rounding_of_time), 1.0, 1e9));
}

/// The number of steps until t is reached, at least one.
std::int64_t LoopClock::steps_until(double t) const {
    const double steps = std::ceil((t - now()) / time.clock.step - rounding_of_time);
    return static_cast<std::int64_t>(std::clamp(steps, 1.0, 1e9));
}

bool LoopClock::observation_due() {
    if (schedule_.next_moment) return true;
    const bool is_multiple = schedule_.interval > 0 && step % schedule_.interval == 0;
    if (!looks_at_marks()) return is_multiple;
    const double seen = marks_reached(now(), schedule_.end_time, schedule_.every);
    const bool due = is_multiple || seen > marks_seen_;
    marks_seen_ = seen;
    return due;
}

}  // namespace cascade
