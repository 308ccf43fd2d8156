// Tries steps and judges them by their errors.
#include "solvers/step_lengths.h"

#include "solvers/spoiled_step.h"

#include <algorithm>
#include <cmath>

namespace cascade {

StepLengths::StepLengths(const Schedule& schedule, const StepProblem& problem, LoopClock& clock,
                         Stepper& stepper, std::vector<Field>& species)
    : schedule_(schedule),
      clock_(clock),
      stepper_(stepper),
      species_(species),
      control_(schedule.time.control, schedule.error_order),
      plain_(&problem),
      judged_(schedule.judged != nullptr ? schedule.judged : &problem) {}

TimeState StepLengths::time() const {
    TimeState time = clock_.time;
    time.control = control_.state();
    return time;
}

void StepLengths::choose(bool rejected) {
    if (!schedule_.choose) return;
    const SpeciesLoan loan(stepper_, species_);
    const StepChoice choice = schedule_.choose(clock_.step, clock_.time, rejected);
    plain_ = choice.problem;
    judged_ = choice.judged;
    clock_.set_step(choice.step);
}

bool StepLengths::take_judged_step(StageOutcome& outcome) {
    if (!schedule_.choose) clock_.set_step(wanted_step());
    while (true) {
        // If almost no time would be left after the next step, this step is made a little longer to
        // reach the end.
        const double end = clock_.next_end(), whole = clock_.time.clock.step;
        const double left = end - clock_.now();
        const double length = left < 1.01 * whole ? left : whole;
        const StepControl::State tried = control_.state();
        clock_.set_step(length);
        stepper_.use(*judged_);
        stepper_.set_clock(clock_.time.clock);
        const CopyRoles before = stepper_.roles();
        const double error = stepper_.attempt(clock_.step, schedule_.tolerance);
        if (control_.judge(length, error)) {
            if (length < whole && end < schedule_.end_time) control_.forget_cut(tried);
            break;
        }
        if (length <= clock_.time.least_step) {
            if (std::isfinite(error)) break;
            return fail_after(before, outcome);
        }
        if (control_.step() < least_step()) {
            outcome.too_short = where_error_is_largest();
            stepper_.set_roles(before);
            return false;
        }
        stepper_.set_roles(before);
        if (schedule_.choose) {
            clock_.time.control = control_.state();
            choose(true);
        } else {
            clock_.set_step(wanted_step());
        }
    }
    ++clock_.step;
    clock_.time.clock.begin_at(clock_.step);
    stepper_.accept();
    pass_jump();
    clock_.time.control = control_.state();
    if (!clock_.is_over()) choose();
    return true;
}

/// If rates and sides jump, the next step begins with the values after the jump.
void StepLengths::pass_jump() {
    if (!schedule_.time_after) return;
    const double t = clock_.now(), after = schedule_.time_after(t);
    if (!(after > t)) return;
    clock_.time.clock.base_time = after;
    stepper_.pass_jump({clock_.step, after});
}

double StepLengths::wanted_step() const {
    const double wanted =
        std::min(std::max(control_.step(), clock_.time.least_step), schedule_.largest_step);
    return schedule_.longest_step ? std::min(wanted, schedule_.longest_step(clock_.now())) : wanted;
}

/// The shortest length of a step. With shorter steps, a run would practically never end.
double StepLengths::least_step() const {
    return 1e-10 * (clock_.has_end_time() ? schedule_.end_time : std::max(clock_.now(), 1.0));
}

/// Restores the state before the last step, which spoiled a value, and copies it to `last_checked`.
bool StepLengths::fail_after(CopyRoles before, StageOutcome& outcome) {
    outcome.not_finite = find_not_finite(stepper_.species(), clock_.step + 1, clock_.step);
    stepper_.set_roles(before);
    // If all values are finite, the rates are not finite.
    if (!outcome.not_finite) {
        outcome.too_short = where_error_is_largest();
        return false;
    }
    for (const Field& field : stepper_.species()) outcome.last_checked.push_back(field.clone());
    return false;
}

StepTooShort StepLengths::where_error_is_largest() const {
    StepTooShort place;
    place.t = clock_.now();
    place.step = control_.step();
    double most = -1;
    const std::vector<Field>& errors = stepper_.error_planes();
    const auto look = [&](std::size_t k, const auto& plane) {
        const PlaneLayout& layout = plane.layout();
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            for (std::int64_t i = 0; i < layout.width; ++i) {
                // NaN counts as the largest error.
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

}  // namespace cascade
