// Prepares a stage in the first call of advance() and continues it in each further call. If steps
// fail, the largest stable speed is estimated from the last good state and from the start of the
// stage.
#include "run/simulation/stage_run.h"

#include "core/parallel.h"
#include "run/simulation/coarse_start.h"
#include "run/simulation/growth_doubts.h"
#include "run/simulation/grown_domain.h"
#include "run/simulation/kernel_maker.h"
#include "run/simulation/other_cells.h"
#include "run/simulation/stage_doubts.h"
#include "run/simulation/stage_tools.h"
#include "run/stage/not_finite.h"
#include "run/stage/stage_time.h"
#include "solvers/executor_failure.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// Returns the number of steps between two entries of a stage's course. Short stages get as many
/// entries as long ones.
std::int64_t look_every(const Stage& stage, std::int64_t usual) {
    constexpr std::int64_t looks = 10;
    return std::clamp<std::int64_t>(stage.iterations / looks, 1, usual);
}

Failure explain(const StepTooShort& place, const StageView& view) {
    Failure failure;
    failure.message = fmt::format(
        "stage '{}' ({}): steps shrink to nothing: at t = {:.6g} even a step of {:.2g} is too "
        "long for {} at {}",
        view.stage().name, view.system().name, place.t, place.step,
        species_name(view.system(), place.species),
        view.environment().place_in_words(place.column, place.row));
    failure.hint =
        "a value jumps or grows without bound there; a larger 'tolerance' or 'solver: euler' may "
        "let the run continue";
    return failure;
}

/// Explains a failure: a value is not finite, or steps have become too short. `state` must be the
/// state that the view shows. If its values are not finite, it is reset to the start of the stage.
Failure explain(const StageOutcome& outcome, const StageView& view, StageState& state,
                const std::atomic<bool>& cancel) {
    const double step = outcome.steps > 0 ? outcome.t / static_cast<double>(outcome.steps) : 0;
    const double end = std::min(duration_of(view.stage(), view.system(), state),
                                step * static_cast<double>(view.stage().iterations));
    if (auto shrinks = shrinks_to_nothing(view.environment(), view.number(), outcome.t, end, step))
        return *shrinks;
    if (!outcome.not_finite) return explain(*outcome.too_short, view);
    NotFiniteReport report;
    report.stage = view.stage().name;
    report.system = view.system().name;
    report.species = species_name(view.system(), outcome.not_finite->species);
    report.found = *outcome.not_finite;
    report.place = view.environment().place_in_words(report.found.column, report.found.row);
    report.use = view.step_in_use();
    if (report.found.at_start() || is_partly_implicit(report.use.solver)) return describe(report);
    const auto estimate = [&](std::span<const Field> species) {
        StabilityEstimate found;
        const KernelMaker& kernels = view.environment().kernels;
        complete([&] { found = view.stability(species, kernels.once(), &cancel); });
        return found;
    };
    const std::size_t count = state.species().size();
    // If no copy of the last good values was kept, `state` contains values that are not finite.
    // This is so even if values are checked after every step.
    const bool keeps = !outcome.last_checked.empty();
    std::vector<Field> last_finite;
    if (keeps) {
        report.estimate_before = estimate(outcome.last_checked);
        report.largest_before = largest_magnitude(state.species());
        last_finite = std::move(state.species());
    }
    // If a state grows towards infinity, it gives a poor estimate of the largest stable speed. So
    // the speed is also estimated at the start of the stage.
    state.species().clear();
    state.species().resize(count);
    state.species() = view.starting_species();
    report.largest_at_start = largest_magnitude(state.species());
    report.estimate_at_start = estimate(state.species());
    report.use.diffusion_limits = view.diffusion_limits();
    if (keeps) {
        state.species() = std::move(last_finite);
    } else {
        // Values that are not finite are useless, so the stage is reset to its start.
        state.time = {};
        state.go_to(0, 0);
    }
    return describe(report);
}

}  // namespace

StageRun::StageRun(const Environment& environment, std::span<StageState> states,
                   std::uint32_t stage, const Keeping& keeping)
    : view_(environment, states, stage, &invariants_),
      states_(states),
      state_(states[stage]),
      keeping_(keeping),
      kernels_(environment.stage(stage).name),
      timer_(*environment.program, stage, state_, [&] {
          const auto when = environment.takes_long(stage) ? TieredBackend::When::now
                                                          : TieredBackend::When::when_used;
          const auto refused = [this](const Failure& refusal) {
              if (control_ != nullptr) kernels_.warn(refusal, *control_);
          };
          StageTools tools = stage_tools(view_, environment.kernels.steps(when, kernels_, refused));
          tools.condition_holds = [this, holds = std::move(tools.condition_holds)] {
              if (control_ != nullptr) undefined_.look_at_until(view_, *control_);
              return holds();
          };
          return tools;
      }()) {
    CHECK(state_.started, "a stage is started before it advances");
}

Result<StageEnd> StageRun::advance(std::int64_t last_step, RunControl& control,
                                   const Observation& observation) {
    control_ = &control;
    next_moment_ = observation.next_moment;
    can_go_on_ = false;
    std::optional<Result<StageEnd>> over;
    const std::optional<Failure> failed = failure_in([&] {
        if (!loop_) over = begin(last_step);
        control.may_end = false;
        if (over) return;
        over = take_steps(last_step, observation);
        if (!*over) over->error().message += note_of_cells(view_.program());
    });
    if (failed) over = reset_after(*failed);
    control_ = nullptr;
    return std::move(*over);
}

/// Resets the stage to its start. The values that it had are lost together with the device.
Result<StageEnd> StageRun::reset_after(Failure why) {
    loop_.reset();
    between_.reset();
    state_.species().clear();
    state_.species().resize(view_.system().species_count());
    state_.species() = view_.starting_species();
    state_.time = {};
    state_.go_to(0, 0);
    why.message = fmt::format("stage '{}': {}", view_.stage().name, why.message);
    return tl::unexpected(std::move(why));
}

/// Prepares the steps of the stage. Returns a result only if the stage ends before its first step.
std::optional<Result<StageEnd>> StageRun::begin(std::int64_t last_step) {
    const Environment& here = view_.environment();
    const Stage& stage = view_.stage();
    if (state_.course.empty()) look();
    if (timer_.substeps() > 1 && state_.steps == 0 && control_->warn) {
        const std::uint32_t stages = StageTimer::stages_for_parts(timer_.substeps());
        const std::string how = stages > 0 ? fmt::format("taken in {} stages of rkl1", stages)
                                           : fmt::format("split into {}", timer_.substeps());
        control_->warn(
            fmt::format("stage '{}': each step is {}, so that it is stable {}", stage.name, how,
                        here.model ? "in the smallest cells of the model" : "with its size"));
    }
    if (state_.steps == 0 && last_step > 0 && control_->warn) {
        const std::string jump = describe_jump_of_lengths(view_);
        if (!jump.empty()) control_->warn(jump);
    }
    if (view_.is_frozen()) return end_frozen(last_step);
    if (state_.steps == 0 && last_step > 0 && stage.time.coarse > 1) {
        auto grown = run_on_coarser_grids(here, states_, view_.number(), *control_);
        if (!grown || *grown == StageEnd::cancelled) return grown;
    }
    if (state_.steps == 0) {
        undefined_.look_at_start(view_, *control_);
        lost_.look(view_, *control_);
    }
    invariants_ = find_step_invariants(view_);
    const StepProblem& problem = timer_.problem();
    tilings_.emplace(here.tilings, problem, kernels_.identity());
    loop_.emplace(problem, schedule(), state_.species(), progress_of(here, view_.number()));
    return std::nullopt;
}

/// Completes all steps at once. If all cells are frozen, nothing changes.
StageEnd StageRun::end_frozen(std::int64_t last_step) {
    const bool has_duration = view_.stage().time.has_duration();
    state_.go_to(has_duration ? 0 : last_step, state_.t);
    state_.done = has_duration || state_.steps >= view_.stage().iterations;
    return state_.done ? StageEnd::finished : StageEnd::stopped;
}

Schedule StageRun::schedule() {
    const Environment& here = view_.environment();
    Schedule schedule = timer_.schedule(view_.stage().iterations, view_.stage().interval);
    if (next_moment_) {
        schedule.next_moment = [this](double t) {
            return next_moment_ ? next_moment_(t) : std::numeric_limits<double>::infinity();
        };
    }
    schedule.marks = view_.stage().interval == 0;
    schedule.check_every = look_every(view_.stage(), schedule.check_every);
    schedule.onlooker = [this](std::int64_t step, double t, std::span<const Field>) {
        if (!state_.course.is_due(step)) return;
        state_.go_to(step, t);
        look();
    };
    schedule.threads = here.tools.threads;
    schedule.executor = here.tools.executor;
    schedule.tiling = here.tools.tiling;
    schedule.tilings = &*tilings_;
    schedule.keep_is_due = keeping_.is_due;
    schedule.keep = [this](std::int64_t step, double t, const TimeState& time) {
        state_.time = time;
        state_.go_to(step, t);
        keeping_.keep();
    };
    return schedule;
}

/// Adds the spread of the present values to the course of the stage (run/stage/stage_course.h).
void StageRun::look() {
    // If `speed` varies, the cells have no common time, so steps are counted in place of time.
    const bool is_timed = view_.stage().uniform[view_.system().speed_item()];
    const double age = is_timed ? state_.t : static_cast<double>(state_.steps);
    state_.course.look(state_.steps, age, state_.species(), view_.environment().counted());
}

/// Called at complete steps. If moments are observed, interpolates the values at the moments since
/// the previous step.
void StageRun::observe(const Observation& observation) {
    if (between_) {
        between_->pass(observation.next_moment, observation.observe, control_->cancel);
    } else if (observation.observe) {
        observation.observe();
    }
}

Result<StageEnd> StageRun::take_steps(std::int64_t last_step, const Observation& observation) {
    const std::int64_t steps_before = state_.steps;
    const std::int64_t interval =
        observation.every > 0 ? observation.every : view_.stage().interval;
    if (next_moment_ && !between_) {
        const bool has_long_steps =
            takes_long_steps(view_.stage().time.solver) || timer_.substeps() > 1;
        between_.emplace(view_, state_, has_long_steps, [this] { return loop_->curve(); });
        observe(observation);  // Before the first step, this only copies the state.
    }
    const StageOutcome outcome =
        loop_->advance(last_step, interval, *control_,
                       [&](std::int64_t step, double t, std::span<const Field>) {
                           state_.go_to(step, t);
                           observe(observation);
                           return true;
                       });
    state_.time = outcome.time;
    state_.go_to(outcome.steps, outcome.t);
    kernels_.warn_of_refused(*control_);
    account_for(state_.steps - steps_before, outcome);
    const bool is_good = !outcome.not_finite && !outcome.too_short && !outcome.cancelled;
    const bool is_done = is_good && (outcome.ended || state_.steps >= view_.stage().iterations);
    const bool looks_for_doubts = control_->warn && (is_done || !control_->checks_later);
    can_go_on_ = is_good && !is_done && state_.steps > 0 && !looks_for_doubts;
    // The checks that follow need the memory that the loop holds.
    if (!can_go_on_) loop_.reset();
    if (outcome.not_finite || outcome.too_short)
        return tl::unexpected(explain(outcome, view_, state_, control_->cancel));
    if (outcome.cancelled) {
        view_.environment().kernels.stepper()->abandon();
        return StageEnd::cancelled;
    }
    if (looks_for_doubts) look_for_doubts();
    state_.done = is_done;
    if (state_.done && !state_.course.empty()) look();
    return state_.done ? StageEnd::finished : StageEnd::stopped;
}

void StageRun::look_for_doubts() {
    const std::string doubt = state_.steps > 0 ? find_doubt({view_, state_, timer_}) : "";
    if (!doubt.empty()) {
        control_->warn(doubt);
        // If there is a doubt about the stage, it gets no remarks, so its course is not needed.
        state_.course = {};
    }
    undefined_.look_at_end(view_, *control_);
    lost_.look(view_, *control_);
    if (lost_.are_told()) state_.course = {};
}

/// Adds the number of steps taken and their time to the account.
void StageRun::account_for(std::int64_t steps, const StageOutcome& outcome) const {
    const Environment& here = view_.environment();
    TimeAccount::Stage& entry = here.account.stage(view_.number());
    entry.steps += steps;
    entry.cells = here.grid.cell_count();
    entry.threads = outcome.threads;
    entry.stepping = loop_->stepping();
    entry.has_refused = kernels_.has_refused();
}

}  // namespace cascade
