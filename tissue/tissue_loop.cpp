// Takes steps, then divides and removes cells.
#include "tissue/tissue_loop.h"

#include "solvers/pace.h"
#include "solvers/schedule.h"
#include "solvers/step_control.h"
#include "tissue/event_rounds.h"
#include "tissue/part_cells.h"
#include "tissue/stiffness.h"
#include "tissue/tissue_moments.h"
#include "tissue/tissue_stepper.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace cascade {

namespace {

constexpr double rise_of_motion = 3;
constexpr double times_of_fastest_rate = 100;
constexpr std::int64_t generations = 4;

/// Number of steps between two estimates of the stiffness.
constexpr std::int64_t steps_of_an_estimate = 16;

}  // namespace

double progress_of(std::span<const double> changes, double step, std::span<const double> sizes,
                   std::span<const std::size_t> restless, double since_event) {
    double most = 0;
    for (std::size_t k = 0; k < changes.size(); ++k) {
        if (std::find(restless.begin(), restless.end(), k) != restless.end()) continue;
        most = std::max(most, changes[k] / step * since_event / sizes[k]);
    }
    return most;
}

bool is_at_rest(const TissueTime& time, double progress, double tolerance) {
    const double since_event = time.t - time.last_event;
    return progress <= tolerance &&
           (time.progress >= rise_of_motion * tolerance || time.stiffness == 0 ||
            since_event * time.stiffness >= times_of_fastest_rate);
}

bool compare_turnover(Tissue& tissue, Turnover& turnover) {
    TissueTime& time = tissue.time;
    const auto cells = static_cast<std::int64_t>(tissue.count());
    const std::int64_t births = tissue.births - time.compared_births;
    const std::int64_t deaths = tissue.deaths - time.compared_deaths;
    if (births < generations * std::max(cells, time.compared_cells)) return false;
    const bool stayed = std::abs(cells - time.compared_cells) * 10 <= cells;
    const bool is_turnover = cells > 0 && stayed && deaths >= generations * cells;
    if (is_turnover) turnover = {births, deaths, cells, time.compared_at, time.t};
    time.compared_at = time.t;
    time.compared_births = tissue.births;
    time.compared_deaths = tissue.deaths;
    time.compared_cells = cells;
    return is_turnover;
}

class TissueLoop::Implementation {
public:
    Implementation(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
                   std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
                   TissueSchedule schedule, Progress progress)
        : rules_(rules),
          surroundings_(surroundings),
          tissue_(tissue),
          species_(species),
          schedule_(std::move(schedule)),
          stepper_(rules, surroundings, tissue, std::move(triangles), species, schedule_),
          progress_(std::move(progress)),
          pace_(std::chrono::steady_clock::now(), tissue.time.steps),
          moments_(schedule_, surroundings, tissue, species_) {
        if (std::isfinite(schedule_.end_time)) progress_.duration = schedule_.end_time;
    }

    TissueOutcome advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                          const TissueObserver& observe) {
        outcome_ = {};
        progress_.steps = last_step;
        pace_.go_on(std::chrono::steady_clock::now(), time().steps);
        stepper_.leave_on(control.cancel);
        report(control, false);
        bool going_on = is_started_ || start();
        while (going_on && !is_over() && time().steps < last_step) {
            if (is_cancelled(control) || !take_step(control) || !happen()) break;
            moments_.observe_end(last_length_);
            if (pace_.report_due(std::chrono::steady_clock::now())) report(control, false);
            if (interval > 0 && time().steps % interval == 0 && observe && !observe(tissue_)) break;
            if (schedule_.check > 0 && time().steps % schedule_.check == 0 &&
                schedule_.ends(tissue_)) {
                outcome_.ended = progress_.condition_met = true;
            }
            if (schedule_.keep_is_due && schedule_.keep_is_due()) schedule_.keep(tissue_);
        }
        outcome_.steps = time().steps;
        outcome_.t = time().t;
        outcome_.list_builds = stepper_.lists().builds();
        report(control, true);
        return outcome_;
    }

private:
    TissueTime& time() { return tissue_.time; }
    bool is_adaptive() const { return schedule_.tolerance > 0; }
    bool is_over() {
        if (tissue_.count() == 0 || time().t >= schedule_.end_time) outcome_.ended = true;
        return outcome_.ended || outcome_.failure;
    }

    bool is_cancelled(const RunControl& control) {
        outcome_.cancelled = control.cancel;
        return outcome_.cancelled;
    }

    bool fail(Failure refusal) {
        outcome_.failure = failure_of(TissueFailure::Kind::too_many_neighbours, tissue_);
        outcome_.failure->refusal = std::move(refusal);
        return false;
    }

    bool start() {
        is_started_ = true;
        if (tissue_.count() == 0) return true;
        outcome_.failure = find_not_finite(tissue_);
        if (outcome_.failure) return false;
        // If a run is resumed, the events at the beginning have already happened, and cells at the
        // same position have already been separated.
        if (time().steps == 0 && part_cells(tissue_, species_, surroundings_, schedule_.seed,
                                            schedule_.stage, tissue_.by_number())) {
            tissue_.pad();
        }
        const auto built = stepper_.cells_changed(true);
        if (!built) return fail(built.error());
        return time().steps > 0 || happen();
    }

    bool estimate() {
        stepper_.lists().begin_step(tissue_);
        // The differences move cells by a thousandth of the mean radius, so lists that are valid
        // for ten times this movement are enough.
        const auto reached = stepper_.reach(tissue_.species, 0.01 * stepper_.lists().mean_radius());
        if (!reached) return fail(reached.error());
        const double found = estimate_stiffness(tissue_, rules_.rates(), stepper_.sizes(),
                                                stepper_.moment(1), stepper_.values());
        // The stored bound may fall by at most half, because cells that have just separated may
        // touch again.
        time().stiffness = std::max(found, time().stiffness / 2);
        time().estimated_at = time().steps;
        return true;
    }

    double first_step() {
        if (time().stiffness > 0) return 1 / time().stiffness;
        return std::isfinite(schedule_.end_time) ? schedule_.end_time / 100 : 0.01;
    }

    /// The least length of a step. With shorter steps the stage would practically never end.
    double least_step() {
        const bool ends = std::isfinite(schedule_.end_time);
        return 1e-10 * (ends ? schedule_.end_time : std::max(time().t, 1.0));
    }

    double next_end() { return std::min(schedule_.end_time, next_mark(time().t, schedule_.every)); }

    double next_length() {
        const double wanted =
            is_adaptive() ? std::min(time().control.step, schedule_.largest_step) : schedule_.step;
        const double whole = std::min(wanted, stepper_.longest_step());
        // If almost no time would be left after the next step, this step is made slightly longer to
        // reach the end.
        const double left = next_end() - time().t;
        return left < 1.01 * whole ? left : whole;
    }

    /// Takes one step. If this fails or is cancelled, returns false and leaves the state of the
    /// last complete step. A resumed run takes this step again.
    bool take_step(const RunControl& control) {
        const auto ordered = stepper_.order_cells();
        if (!ordered) return fail(ordered.error());
        const bool uses_stiffness = is_stabilised(schedule_.solver) || time().estimated_at < 0;
        if (uses_stiffness && (time().estimated_at < 0 ||
                               time().steps - time().estimated_at >= steps_of_an_estimate)) {
            if (!estimate()) return false;
        }
        if (time().control.step <= 0) time().control.step = first_step();
        while (!is_cancelled(control)) {
            const double length = next_length();
            const auto tried = stepper_.attempt(length);
            if (!tried) return fail(tried.error());
            if (tried->is_abandoned) continue;
            if (is_accepted(*tried, length)) return finish_step(*tried, length);
            const bool is_finite = !std::isnan(tried->error);
            if (!is_adaptive() || time().control.step < least_step()) {
                return fail_after(*tried, is_finite);
            }
            stepper_.undo(*tried);
            if (is_stabilised(schedule_.solver) && time().estimated_at < time().steps) {
                if (!estimate()) return false;
            }
        }
        return false;
    }

    bool is_accepted(const TriedStep& tried, double length) {
        if (!is_adaptive()) return !tried.went_too_far && tried.error == 0;
        const int order = order_of_estimate(schedule_.solver);
        StepControl control(time().control, order);
        double error = tried.error;
        // A movement that is too long counts as an error that halves the step.
        if (tried.went_too_far) error = std::max(error, std::pow(2.0, order));
        const bool is_accepted = control.judge(length, error);
        const double end = next_end();
        const bool ends_at_mark = end < schedule_.end_time && length == end - time().t;
        if (is_accepted && ends_at_mark && length < time().control.step)
            control.forget_cut(time().control);
        time().control = control.state();
        return is_accepted;
    }

    /// Finds the cell that failed, and restores the last good values.
    bool fail_after(const TriedStep& tried, bool is_finite) {
        using Kind = TissueFailure::Kind;
        if (!is_finite) outcome_.failure = find_not_finite(tissue_);
        if (!outcome_.failure) {
            const Kind kind = is_adaptive() ? Kind::too_short : Kind::too_far;
            outcome_.failure = failure_of(is_finite ? kind : Kind::rate_not_finite, tissue_);
            if (is_adaptive()) find_worst(*outcome_.failure);
        }
        stepper_.undo(tried);
        return false;
    }

    void find_worst(TissueFailure& failure) {
        const std::vector<double> sizes = stepper_.sizes();
        double most = -1;
        for (const std::uint32_t cell : tissue_.by_number()) {
            for (std::size_t k = 0; k < sizes.size() && !std::isnan(most); ++k) {
                const double error = stepper_.errors()[k].visit([&](const auto& plane) {
                    return std::abs(double{plane.origin()[tissue_.element(cell)]}) / sizes[k];
                });
                // NaN counts as the largest error.
                if (error <= most) continue;
                most = error;
                failure.number = tissue_.numbers()[cell];
                failure.species = k;
            }
        }
    }

    /// Finds the events of a step. If there are too many events for one step, the step ends early,
    /// and the later events happen in later steps.
    bool finish_step(TriedStep tried, double length) {
        events_.clear();
        is_quiet_ = has_all_events_ = false;
        last_length_ = length;
        const bool has_conditions = rules_.conditions().values.problem != nullptr;
        CurveUser use;
        if (moments_.is_within(length)) {
            use = [this](const StepCubic& curve, double part) { moments_.observe(curve, part); };
        }
        if (has_conditions || use) {
            const auto found = stepper_.events(tried, length, use);
            if (!found) {
                stepper_.undo(tried);
                return fail(found.error());
            }
            events_ = std::move(found->events);
            is_quiet_ = events_.empty();
            has_all_events_ = found->has_all;
            length *= found->part;
        }
        const double t = stepper_.moment(length).next_t;
        watch_rest(tried, length, t);
        stepper_.accept();
        time().t = t;
        ++time().steps;
        hold_cells_inside();
        return true;
    }

    void watch_rest(const TriedStep& tried, double length, double t) {
        if (schedule_.steady <= 0) return;
        std::vector<Field> beginning = stepper_.lend_beginning(tried);
        const std::vector<double> changes =
            root_mean_squares(tissue_.species, tissue_, stepper_.team(), &beginning);
        stepper_.take_beginning(tried, std::move(beginning));
        now_ = progress_of(changes, length, stepper_.sizes(), species_.restless,
                           t - time().last_event);
        time().progress = std::max(time().progress, now_);
    }

    void hold_cells_inside() {
        const std::array<double, 3> period = surroundings_.period();
        const auto shift = [&](std::uint32_t cell, Vector3d moved) {
            stepper_.lists().watch()->shift(cell, {period[0] > 0 ? moved.x : 0,
                                                   period[1] > 0 ? moved.y : 0,
                                                   period[2] > 0 ? moved.z : 0});
        };
        if (!hold_inside(tissue_, species_, surroundings_, shift)) return;
        is_quiet_ = has_all_events_ = false;
        stepper_.forget_rates();
    }

    /// Divides and removes the cells whose conditions hold now. Returns whether the stage
    /// continues.
    bool happen() {
        EventRounds rounds(rules_, surroundings_, tissue_, species_, schedule_, stepper_);
        double last_event = time().t;
        if (!events_.empty()) last_event -= events_.back().left;
        if (!is_quiet_) outcome_.failure = rounds.happen(std::move(events_), has_all_events_);
        if (outcome_.failure) return false;
        if (rounds.has_changed()) {
            time().last_event = last_event;
            time().progress = 0;
            Turnover turnover;
            if (compare_turnover(tissue_, turnover) && !outcome_.turnover) {
                outcome_.turnover = turnover;
                if (schedule_.turns_over) std::exchange(schedule_.turns_over, {})(turnover);
            }
        } else if (schedule_.steady > 0 && time().steps > 0 &&
                   is_at_rest(time(), now_, schedule_.steady)) {
            outcome_.ended = outcome_.is_steady = progress_.condition_met = true;
        }
        return true;
    }

    void report(RunControl& control, bool is_done) {
        if (!control.report) return;
        const auto now = std::chrono::steady_clock::now();
        pace_.reported(now, time().steps);
        Progress progress = progress_;
        progress.step = time().steps;
        progress.t = time().t;
        progress.steps_per_second = pace_.steps_per_second();
        progress.stage_done = is_done;
        control.report(progress);
    }

    TissueRules& rules_;
    const Surroundings& surroundings_;
    Tissue& tissue_;
    TissueSpecies species_;
    TissueSchedule schedule_;
    TissueStepper stepper_;
    Progress progress_;
    Pace pace_;
    TissueMoments moments_;
    TissueOutcome outcome_;
    std::vector<CellEvent> events_;  ///< Events of the last step that have not been applied yet.
    /// Whether no condition holds at the end of the last step.
    bool is_quiet_ = false;
    /// For cells without an event in `events_`: whether no condition holds at the end of the last
    /// step.
    bool has_all_events_ = false;
    double now_ = 0;          ///< The result of progress_of() for the present tissue.
    double last_length_ = 0;  ///< The length of the last step, before it was ended early.
    bool is_started_ = false;
};

TissueLoop::TissueLoop(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
                       std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
                       TissueSchedule schedule, Progress progress)
    : self_(std::make_unique<Implementation>(rules, surroundings, tissue, std::move(triangles),
                                             species, std::move(schedule), std::move(progress))) {}
TissueLoop::~TissueLoop() = default;

TissueOutcome TissueLoop::advance(std::int64_t last_step, std::int64_t interval,
                                  RunControl& control, const TissueObserver& observe) {
    return self_->advance(last_step, interval, control, observe);
}

}  // namespace cascade
