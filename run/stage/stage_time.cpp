// Builds the problem of a step for the number of stages in use. Chooses steps by stability bounds,
// by error estimates and by the changes that depend on time alone.
#include "run/stage/stage_time.h"

#include "lang/calculus/derivative.h"
#include "lang/calculus/time_parts.h"
#include "solvers/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade {

namespace {

/// The duration that is assumed for a stage whose duration is unknown. Chosen steps are limited to
/// a fraction of the duration.
constexpr double usual_duration = 10000;
constexpr double most_of_duration = 0.05, most_of_duration_without_bound = 0.001;
/// The first step is this fraction of the longest stable step of Euler's method. It is short
/// because there is no error estimate before it.
constexpr double part_of_first_step = 0.25;
/// A chosen step is at least as long as the smaller of two lengths: the first fraction of the
/// longest stable step of Euler's method, and the second fraction of the duration. Shorter steps
/// would gain nothing.
constexpr double least_part = 0.01, least_of_duration = 1e-6;
/// Explicit steps cost little compared with an estimate of their error, so several steps are taken
/// from one estimate to the next. These are the largest numbers of such steps.
constexpr std::int64_t most_stretch = 64, most_stretch_with_jumps = 8;
/// At least this many times during a stage, errors are estimated. They are estimated more often if
/// bounds or errors change.
constexpr double stretches_of_duration = 50;
constexpr double same_bounds = 1.25, small_error = 0.5;
/// The number of stages changes only if steps then cost less by this factor, because each new
/// number of stages needs new temporaries.
constexpr double worth_other_stages = 1.1;
/// The fraction of a bound that counts as reaction if the bound of the reaction is unknown. The
/// rest of the bound counts as diffusion.
constexpr double share_of_reaction = 0.02;

}  // namespace

bool steps_by_item(const Stage& stage) {
    return takes_speed_by_cell(stage.time.solver) && !stage.time.automatic_speed &&
           !stage.time.has_duration() && !(stage.time.every > 0);
}

bool judges_all_steps(const Stage& stage) {
    return stage.time.chooses_steps() &&
           (is_adaptive(stage.time.solver) || takes_long_steps(stage.time.solver));
}

double duration_of(const Stage& stage, const System& system, const StageState& state) {
    if (stage.time.duration) return *stage.time.duration;
    if (!stage.time.duration_in_steps) return std::numeric_limits<double>::infinity();
    return static_cast<double>(*stage.time.duration_in_steps) * state.numbers[system.speed_item()];
}

StageTimer::StageTimer(const Program& program, std::uint32_t stage, StageState& state,
                       StageTools tools)
    : stage_(program.stages[stage]),
      state_(state),
      tools_(std::move(tools)),
      species_(static_cast<std::uint32_t>(state.species().size())) {
    const System& system = program.system_of(stage);
    uniform_speed_ = stage_.uniform[system.speed_item()];
    speed_ = uniform_speed_ ? state.numbers[system.speed_item()] : 1;
    duration_ = duration_of(stage_, system, state);
    if (chooses()) {
        if (const auto bound = jacobian_bound(program, stage, tools_.model)) {
            const bool is_local = is_locally_implicit(stage_.time.solver);
            const Formula* const formulas[] = {is_local ? &bound->spread : &bound->whole,
                                               is_local ? &bound->growth : &bound->reaction};
            bounds_by_rule_ = tools_.numbers(formulas);
            jumps_ = bound->jumps;
        }
    }
    if (stage_.time.chooses_steps()) forcing_ = forcing(program, stage);
    state_.time.clock.precision = program.domain.precision;
    // A resumed stage continues with its stored step control.
    if (state_.steps > 0 && state_.time.control.step > 0) return;
    begins_anew_ = state_.steps > 0;
    state_.time = {};
    state_.time.clock.precision = program.domain.precision;
    state_.time.clock.base_step = state_.steps;
    state_.time.clock.base_time = state_.t;
    state_.time.clock.step = uniform_speed_ ? speed_ : 0;
    state_.time.control.step = speed_;
    state_.time.stages = is_stabilised(stage_.time.solver) ? 3 : 0;
    // The edge of a source that moves can reach cells in which nothing else happens, and a source
    // can begin where a species is 0. If a step includes such a moment, its relative error does not
    // depend on its length.
    if (is_adaptive(stage_.time.solver) && (forcing_.has_motion() || forcing_.has_rest())) {
        state_.time.least_step = least_of_duration * duration_;
    }
    if (chooses_by_error()) set_first_step();
    const bool is_finer = program.domain.detail > 1 || (stage_.size && stage_.size->factor > 1);
    if (program.domain.model || is_finer) state_.time.stages = substeps(program, stage);
    if (stage_.time.steady) state_.watch.begin(state_.species());
}

/// Whether the values of species determine the length of steps or the number of stages.
bool StageTimer::chooses() const { return is_stabilised(stage_.time.solver) || chooses_by_error(); }

bool StageTimer::chooses_by_error() const {
    return stage_.time.automatic_speed && !is_adaptive(stage_.time.solver);
}

Forcing StageTimer::forcing(const Program& program, std::uint32_t stage) const {
    if (!std::isfinite(duration_) || duration_ <= 0) return {};
    Forcing forcing(duration_);
    const TimeParts parts = parts_of_time(program, stage);
    for (const Formula& part : parts.of_time) {
        const ValueAt at = tools_.at_time(part);
        const std::vector<double> values = values_over(duration_, at);
        forcing.add(values);
        forcing.add_jumps(find_jumps(values, duration_, at));
    }
    for (const Formula& part : parts.of_places) forcing.add_motion(tools_.motion(part, duration_));
    return forcing;
}

void StageTimer::set_first_step() {
    TimeState& time = state_.time;
    look_at_bounds(state_.steps, time);
    time.control.step = longest_step(time.bounded_at >= 0);
    if (time.bounds.whole > 0) {
        time.control.step = std::min(time.control.step, part_of_first_step * 2 / time.bounds.whole);
    }
}

/// Returns the number of parts into which a step is divided. The links of a model's cells have
/// different weights, and the largest weight limits the stable step. A script that is stable on a
/// plane should also be stable on a model and with a larger size. Explicit Euler is stable for
/// steps of at most 2 / (largest eigenvalue).
std::uint32_t StageTimer::substeps(const Program& program, std::uint32_t stage) const {
    constexpr double safety = 0.95;
    const bool is_split =
        stage_.time.solver == Solver::euler && !stage_.time.automatic_speed && uniform_speed_;
    if (!is_split) return state_.time.stages;
    double decay = 0;
    if (const auto bound = jacobian_bound(program, stage, tools_.model)) {
        const Formula* const formulas[] = {&bound->whole, &bound->reaction};
        const std::vector<double> bounds = tools_.numbers(formulas)();
        // In a grown pattern, reaction and diffusion are fastest in different cells. The difference
        // of their bounds would then be too small, so the whole bound is used.
        decay = begins_anew_ ? bounds[0] : bounds[0] - bounds[1];
    } else {
        // There is no rule for bounds, for example because the direction of diffusion depends on a
        // species.
        decay = tools_.estimate();
    }
    if (!std::isfinite(decay)) return state_.time.stages;
    const double parts = std::ceil(speed_ * decay / (2 * safety));
    return parts > 1 && parts <= most_substeps ? static_cast<std::uint32_t>(parts) : 0;
}

const StepProblem& StageTimer::problem() {
    return problem_of(state_.time.stages, judges_all_steps(stage_));
}

/// Runge-Kutta-Legendre of first order generalises Euler's method, so its stages can replace parts.
/// Up to three parts are not replaced, because they cost no more than three stages.
std::uint32_t StageTimer::stages_for_parts(std::uint32_t parts) {
    constexpr std::uint32_t few = 3;
    const std::uint32_t stages = stages_for(Solver::rkl1, parts);
    const bool is_stable = stability_interval(Solver::rkl1, stages) >= 2.0 * parts;
    return parts > few && is_stable ? stages : 0;
}

Scheme StageTimer::scheme_of(std::uint32_t stages) const {
    const Solver solver = stage_.time.solver;
    if (solver != Solver::euler || stages <= 1)
        return make_scheme(solver, species_, steps_by_item(stage_), stages);
    return split_scheme(species_, stages);
}

Scheme StageTimer::split_scheme(std::uint32_t species, std::uint32_t parts) {
    const std::uint32_t of_legendre = stages_for_parts(parts);
    return of_legendre > 0 ? make_scheme(Solver::rkl1, species, false, of_legendre)
                           : make_substeps(parts);
}

const StepProblem& StageTimer::problem_of(std::uint32_t stages, bool is_judged) {
    const std::pair key(stages, is_judged);
    const auto known = problems_.find(key);
    if (known != problems_.end()) return known->second;
    Scheme scheme = scheme_of(stages);
    if (is_judged && !scheme.error_register) scheme = with_error_estimate(std::move(scheme));
    return problems_.emplace(key, tools_.bind(scheme)).first->second;
}

RateBounds StageTimer::bounds() const {
    if (bounds_by_rule_) {
        const std::vector<double> bounds = bounds_by_rule_();
        if (std::isfinite(bounds[0]) && std::isfinite(bounds[1]))
            return {bounds[0], bounds[1], jumps_};
    }
    const double whole = tools_.estimate();
    // The explicit part may be as fast as the whole system, because it includes advection.
    if (is_partly_implicit(stage_.time.solver)) return {whole, whole, jumps_};
    return {whole, share_of_reaction * whole, jumps_};
}

/// Chooses the number of stages at a given step. The length of steps is fixed.
StepChoice StageTimer::choose_stages_at(std::int64_t step, TimeState& time) {
    state_.go_to(step, time.clock.at(step));
    time.stages = choose_stages(stage_.time.solver, bounds(), speed_);
    return {speed_, &problem_of(time.stages, false), nullptr};
}

double StageTimer::expected_duration() const {
    return std::isfinite(duration_) ? duration_ : usual_duration;
}

double StageTimer::longest_step(bool is_bounded) const {
    return (is_bounded ? most_of_duration : most_of_duration_without_bound) * expected_duration();
}

/// Computes the bounds at a step. Bounds that are not finite count as unknown, and are computed
/// again in the next step.
void StageTimer::look_at_bounds(std::int64_t step, TimeState& time) {
    time.bounds = bounds();
    time.bounded_at = step;
    if (std::isfinite(time.bounds.whole) && std::isfinite(time.bounds.reaction)) return;
    time.bounds = {0, 0, jumps_};
    time.bounded_at = -1;
}

StepChoice StageTimer::choose_by_error(std::int64_t step, TimeState& time, bool rejected) {
    state_.go_to(step, time.clock.at(step));
    const Solver solver = stage_.time.solver;
    if (!rejected && step > 0) {
        state_.course.add_errors(state_.t, static_cast<double>(time.stretch) *
                                               time.control.error_before *
                                               stage_.time.step_tolerance());
    }
    const bool is_long = takes_long_steps(solver);
    const bool by_rule = bounds_by_rule_ != nullptr;
    const std::int64_t renewal = by_rule && !is_long ? 1 : choose_every(solver, by_rule);
    const RateBounds before = time.bounds;
    const bool is_old = time.bounded_at < 0 || step - time.bounded_at >= renewal;
    if (is_old || (rejected && time.bounded_at != step)) look_at_bounds(step, time);

    const double longest = longest_step(time.bounded_at >= 0);
    const double by_time = forcing_.longest_step(state_.t);
    const double wanted =
        std::min({time.control.step, longest, stage_.time.largest_step.value_or(longest), by_time});
    const double part = reaction_part_at(solver, stage_.time.step_tolerance());
    SafeStep safe = safe_step(solver, time.bounds, wanted, part);
    if (is_stabilised(solver) && time.stages >= least_stages(solver)) {
        const double same = std::min(stable_step(solver, time.bounds, time.stages), wanted);
        if (safe.length * time.stages <= worth_other_stages * same * safe.stages)
            safe = {same, time.stages};
    }
    time.stages = safe.stages;
    time.least_step = least_of_duration * expected_duration();
    // If a solver is implicit in each cell, the bound leaves out the local reaction, which may be
    // faster than the bound. So the bound sets no least step.
    if (time.bounds.whole > 0 && !is_locally_implicit(solver))
        time.least_step = std::min(time.least_step, least_part * 2 / time.bounds.whole);
    time.stretch = is_long ? 1 : stretch_after(before, time, rejected, safe.length, by_time);
    time.next_judged = step + time.stretch;
    return {safe.length, &problem_of(time.stages, is_long), &problem_of(time.stages, true)};
}

/// Returns the number of steps until the next error estimate.
std::int64_t StageTimer::stretch_after(const RateBounds& before, const TimeState& time,
                                       bool rejected, double length, double longest) const {
    if (rejected || time.bounded_at < 0) return 1;
    const double low = std::min(before.whole, time.bounds.whole);
    const double high = std::max(before.whole, time.bounds.whole);
    const bool is_calm = high <= same_bounds * low && time.control.error_before <= small_error;
    const std::int64_t wanted = is_calm ? 2 * time.stretch : time.stretch / 2;
    const double by_time =
        std::min(std::min(expected_duration() / stretches_of_duration, longest) / length, 1e9);
    const std::int64_t most = std::min(time.bounds.jumps ? most_stretch_with_jumps : most_stretch,
                                       static_cast<std::int64_t>(by_time));
    return std::max<std::int64_t>(1, std::min(wanted, most));
}

bool StageTimer::has_ended(std::int64_t step, double t) {
    state_.go_to(step, t);
    if (stage_.time.until) return tools_.condition_holds();
    // If `speed` varies, cells have no common time, so the number of steps is used as the age.
    const double age = uniform_speed_ ? t : static_cast<double>(state_.steps);
    return state_.watch.settled(state_.species(), age, *stage_.time.steady, tools_.inside);
}

Schedule StageTimer::schedule(std::int64_t last_step, std::int64_t interval) {
    Schedule schedule;
    schedule.first_step = state_.steps;
    schedule.last_step = last_step;
    schedule.time = state_.time;
    schedule.begins_anew = begins_anew_;
    schedule.end_time = duration_;
    schedule.interval = interval;
    schedule.every = stage_.time.every;
    if (uniform_speed_ && !stage_.time.chooses_steps()) schedule.fixed_step = speed_;
    if (stage_.time.until || stage_.time.steady) {
        schedule.check = stage_.time.steps_between_looks();
        schedule.ends = [this](std::int64_t step, double t, std::span<const Field>) {
            state_.condition_met = has_ended(step, t);
            return state_.condition_met;
        };
    }
    if (stage_.time.chooses_steps()) {
        schedule.tolerance = stage_.time.step_tolerance();
        schedule.largest_step = stage_.time.largest_step.value_or(schedule.largest_step);
        schedule.longest_step = [this](double t) { return forcing_.longest_step(t); };
        schedule.time_after = [this](double t) { return forcing_.time_after(t); };
        schedule.judges_all = judges_all_steps(stage_);
        schedule.error_order = order_of_estimate(stage_.time.solver);
    }
    if (chooses_by_error()) {
        if (!schedule.judges_all) schedule.judged = &problem_of(state_.time.stages, true);
        schedule.choose = [this](std::int64_t step, TimeState& time, bool rejected) {
            return choose_by_error(step, time, rejected);
        };
    } else if (chooses()) {
        schedule.choose_every = choose_every(stage_.time.solver, bounds_by_rule_ != nullptr);
        schedule.choose = [this](std::int64_t step, TimeState& time, bool) {
            return choose_stages_at(step, time);
        };
    }
    return schedule;
}

}  // namespace cascade
