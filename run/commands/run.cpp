// Refuses requests that cannot be fulfilled, runs the stages, and writes the results.
#include "run/commands/run.h"

#include "core/with_commas.h"
#include "lang/program/stage_kinds.h"
#include "run/commands/outlooks.h"
#include "run/commands/runner.h"
#include "run/pictures/measured.h"
#include "run/pictures/picture_remarks.h"
#include "run/simulation/end_remarks.h"
#include "run/stage/stage_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace cascade {

Result<StageEnd> Runner::run_stage(std::uint32_t k) {
    const Stage& stage = script_.program->stages[k];
    if (!simulation_->state(k).started) {
        if (auto started = simulation_->start_stage(k, control_.cancel); !started) {
            if (control_.cancel) return StageEnd::cancelled;
            return tl::unexpected(started.error());
        }
        // Until a later stage has taken a step, pictures show the previous stage. Its last frame
        // has already been recorded.
        if (stage.iterations > 0 && simulation_->state(shown_stage(*simulation_)).steps == 0) {
            look();
        }
    }
    if (simulation_->state(k).done) return StageEnd::finished;
    if (log_) log_->record(*simulation_, k);
    std::int64_t last = stage.iterations;
    const bool stops_here =
        request_.stop_at && request_.stop_at->stage == stage.name && request_.stop_at->step <= last;
    if (stops_here) last = request_.stop_at->step;
    const std::int64_t before = simulation_->state(k).steps;
    marks_seen_ = marks_done(k);
    const auto start = Clock::now();
    auto end = simulation_->advance_stage(
        k, std::max(last, before), control_, [&] { observe(k); }, observation_interval(stage),
        moments_of(moments_, *simulation_, k));
    report_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    report_.steps += simulation_->state(k).steps - before;
    if (log_) log_->record(*simulation_, k);
    if (series_ && simulation_->state(k).steps > before) add_to_series(k);
    if (stops_here && end && *end == StageEnd::finished) return StageEnd::stopped;
    return end;
}

/// Whether no computed values are lost if the run ends before its first step. Later, the first step
/// of a stage of fields sets `may_end` to false. A stage of cells that crawl does not.
bool Runner::has_nothing_to_lose() const {
    return request_.resume.empty() && !is_of_cells(*simulation_->domain(0).program, 0);
}

Result<void> Runner::run_stages() {
    for (std::uint32_t k = 0; k < script_.stage_count(); ++k) {
        const std::int64_t before = simulation_->state(k).steps;
        if (before == 0) remark(outlook(*simulation_->domain(k).program, k));
        auto end = run_stage(k);
        if (!end) return tl::unexpected(end.error());
        report_.where = place();
        if (*end == StageEnd::finished) {
            if (simulation_->state(k).steps > before) remark(remark_on(*simulation_, k));
            continue;
        }
        report_.status = *end == StageEnd::cancelled ? RunStatus::cancelled : RunStatus::stopped;
        return {};
    }
    return {};
}

/// Transfers the end of a finished run to the smaller cells of --detail.
Result<void> Runner::settle_in_detail() {
    if (!detailed_ || report_.status != RunStatus::finished) return {};
    const auto start = Clock::now();
    is_detailed_ = true;
    const auto end = detailed_->settle(*simulation_, control_);
    if (!end) return tl::unexpected(end.error());
    report_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    const std::uint32_t stage = shown_stage(*simulation_);
    report_.steps += shown().state(stage).steps - simulation_->state(stage).steps;
    if (*end == StageEnd::cancelled) {
        report_.status = RunStatus::cancelled;
        report_.where += ", settling in finer cells";
    }
    return {};
}

void Runner::remark(std::string words) {
    if (words.empty()) return;
    if (control_.warn) control_.warn(words);
    report_.remarks.push_back(std::move(words));
}

/// For a resumed run, adds a remark on each stage that could take more steps if the next stage had
/// not already begun with its final state. If the saved run was complete already, adds a remark on
/// that.
void Runner::remark_on_resumed() {
    const auto& stages = script_.program->stages;
    for (std::uint32_t k = 0; k + 1 < script_.stage_count(); ++k) {
        const StageState& state = simulation_->state(k);
        const bool is_short = state.done && !state.condition_met &&
                              !stages[k].time.has_duration() && state.steps < stages[k].iterations;
        if (!is_short || !simulation_->state(k + 1).started) continue;
        remark(
            fmt::format("stage '{}' stays at step {}, because stage '{}' has already begun "
                        "from it",
                        stages[k].name, with_commas(state.steps), stages[k + 1].name));
    }
    if (report_.steps > 0 || report_.status != RunStatus::finished) return;
    remark(fmt::format("the saved run was complete already, so no steps were taken: {}", place()));
}

/// Returns the largest number of steps between observations that misses no frame and no row of the
/// log.
std::int64_t Runner::observation_interval(const Stage& stage) const {
    if (!log_) return stage.interval;
    return frames_ || series_ ? std::gcd(log_->every(stage), stage.interval) : log_->every(stage);
}

/// Whether it is time for a frame. A stage with an interval has frames at this interval. Any other
/// stage has frames at its marks: at the multiples of `every` or at the tenths of its duration.
bool Runner::frame_is_due(std::uint32_t k) {
    const std::int64_t interval = script_.program->stages[k].interval;
    if (interval > 0) return simulation_->state(k).steps % interval == 0;
    const double before = std::exchange(marks_seen_, marks_done(k));
    return marks_seen_ > before;
}

double Runner::marks_done(std::uint32_t k) const {
    const StageState& state = simulation_->state(k);
    const Program& program = *script_.program;
    const Stage& stage = program.stages[k];
    return marks_reached(state.t, duration_of(stage, program.system_of(k), state),
                         stage.time.every);
}

void Runner::observe(std::uint32_t k) {
    const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
    const Stage& stage = script_.program->stages[k];
    const std::int64_t step = simulation_->state(k).steps;
    if (moments_.any()) {
        look();
        if (log_) log_->record(*simulation_, k);
        return;
    }
    if (frame_is_due(k)) look();
    const std::int64_t every = log_ ? log_->every(stage) : 0;
    if (log_ && (every == 0 || step % every == 0)) log_->record(*simulation_, k);
}

void Runner::look() {
    if (!frames_ && !series_) return;
    const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
    const auto stage = shown_stage(*simulation_);
    if (series_) add_to_series(stage);
    if (!frames_) return;
    frames_->record(painter_->canvas(*simulation_), script_.program->stages[stage].name,
                    simulation_->state(stage).steps,
                    labels_ ? labels_->text(*simulation_, stage) : "");
}

/// Adds the present moment to the series, unless the series already contains it because a stage has
/// ended at one of its intervals.
void Runner::add_to_series(std::uint32_t stage) {
    const double t = time_of(*simulation_, stage);
    const std::pair moment(stage, std::isnan(t)
                                      ? static_cast<double>(simulation_->state(stage).steps)
                                      : t);
    if (last_in_series_ == moment) return;
    last_in_series_ = moment;
    series_->add(*simulation_);
}

/// Adds remarks on times of --at that are later than the end of the run.
void Runner::remark_on_moments() {
    const std::uint32_t stage = shown_stage(*simulation_);
    const double end = time_since_start(*simulation_);
    if (moments_.at.empty() || stage + 1 < script_.stage_count()) return;
    if (moments_.at.back() <= end * (1 + 1e-9)) return;
    remark(fmt::format("the run ends at t = {:.6g}, before the time {:.6g} of --at", end,
                       next_moment(moments_, 0, end)));
}

std::string Runner::place() const {
    const auto stage = shown_stage(*simulation_);
    const Stage& at = script_.program->stages[stage];
    return fmt::format("stage '{}', {}", at.name, describe_place(at, simulation_->state(stage)));
}

RunResults Runner::results() {
    return {is_detailed_ ? detailed_->script() : script_,
            request_,
            control_,
            outputs_,
            shown(),
            {script_, *simulation_},
            texture_,
            painter(),
            is_detailed_ ? detailed_->panels() : panels_,
            frames_ ? &*frames_ : nullptr,
            earlier_frames_,
            log_ ? &*log_ : nullptr,
            series_.get(),
            report_};
}

Result<RunReport> Runner::run() {
    if (auto ready = prepare(); !ready) return tl::unexpected(ready.error());
    if (report_.status == RunStatus::cancelled) return std::move(report_);
    report_.has_begun = true;
    control_.may_end = has_nothing_to_lose();
    if (writes_one_moment(request_)) {
        report_.where = place();
    } else if (auto done = run_stages(); !done) {
        // The log is written because it shows the values that led to the failure.
        if (log_) (void)results().write_log();
        return tl::unexpected(done.error());
    }
    control_.may_end = false;
    if (auto done = settle_in_detail(); !done) return tl::unexpected(done.error());
    if (!request_.resume.empty()) remark_on_resumed();
    if (report_.status == RunStatus::finished) remark_on_moments();
    const RunResults::Early early = results().write_early();
    control_.may_end = true;
    // For a body, making the canvas may take longer than the steps, so the canvas is made only
    // once.
    const Canvas canvas = [&] {
        const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
        return painter().canvas(shown());
    }();
    if (report_.status == RunStatus::finished && report_.steps > 0) {
        remark(remark_on_picture(painter(), shown(), canvas));
        // With --sheet, palette and range have an effect, because a sheet shows numbers.
        if (request_.sheet.empty()) remark(remark_on_look(painter(), shown(), canvas));
        const bool shows_material = request_.picture.show.empty() && request_.sheet.empty() &&
                                    !request_.model_files.has_maps();
        if (shows_material) remark(remark_on_material(script_, canvas));
        if (frames_ && frames_->holds_starts_alone()) {
            remark(fmt::format(
                "{} nothing but starting values: 'interval' is longer than each stage",
                request_.picture.space_time ? "the space-time picture shows" : "the frames show"));
        }
    }
    if (request_.features) {
        const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
        report_.features = measure_shown(painter(), shown());
    }
    if (auto written = results().write(canvas, early); !written)
        return tl::unexpected(written.error());
    return std::move(report_);
}

Result<RunReport> run(Script& script, const RunRequest& request, RunControl& control) {
    Runner runner(script, request, control);
    auto report = runner.run();
    runner.settle();
    return report;
}

}  // namespace cascade
