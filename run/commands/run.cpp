// The order of a run: requests that cannot be met are refused first, then the stages run, then the
// results are written.
#include "run/commands/run.h"

#include "core/with_commas.h"
#include "export/bake.h"
#include "run/commands/analyze.h"
#include "run/commands/detailed_run.h"
#include "run/commands/frame_labels.h"
#include "run/commands/run_checks.h"
#include "run/commands/run_results.h"
#include "run/pictures/map_size.h"
#include "run/pictures/frame_folder.h"
#include "run/pictures/frames.h"
#include "run/pictures/measured.h"
#include "run/pictures/picture_remarks.h"
#include "run/pictures/picture_size.h"
#include "run/session/live_run.h"
#include "run/stage/stage_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <utility>

namespace cascade {

namespace {

using Clock = std::chrono::steady_clock;

class Runner {
public:
    Runner(Script& script, const RunRequest& request, RunControl& control)
        : script_(script), request_(request), control_(control) {}

    Result<RunReport> run();
    /// Ends the simulation, which may report on its stages.
    void settle() {
        if (simulation_) simulation_->settle(control_);
    }

private:
    Result<void> prepare();
    Result<void> check_places(Folders folders);
    Result<void> make_simulation();
    Result<void> find_texture(const SurfaceMesh& mesh);
    void choose_map_size();
    Result<std::unique_ptr<LiveRun>> play_session();
    bool has_cancelled(std::string what);
    Result<void> run_stages();
    Result<void> make_detailed();
    Result<void> settle_in_detail();
    Result<StageEnd> run_stage(std::uint32_t stage);
    void remark(std::string words);
    void remark_on_resumed();
    void look();
    void observe(std::uint32_t stage);
    bool frame_is_due(std::uint32_t stage);
    double tenths_done(std::uint32_t stage) const;
    std::int64_t observation_interval(const Stage& stage) const;
    void keep_while_running();
    std::string place() const;
    RunResults results();
    const Simulation& shown() const {
        return is_detailed_ ? detailed_->simulation() : *simulation_;
    }
    Painter& painter() { return is_detailed_ ? detailed_->painter() : *painter_; }

    Script& script_;
    RunRequest request_;
    RunControl& control_;
    RunReport report_;
    std::vector<std::filesystem::path> outputs_;
    std::unique_ptr<Simulation> simulation_;
    MeshTexture texture_;                    ///< That was made for the model.
    std::unique_ptr<DetailedRun> detailed_;  ///< Null without --detail.
    bool is_detailed_ = false;               ///< Has the run been carried there?
    std::optional<Painter> painter_;
    std::vector<Painter> panels_;  ///< Of figures.
    std::optional<FrameRecorder> frames_;
    std::optional<FrameLabels> labels_;
    std::vector<std::filesystem::path> earlier_frames_;  ///< Of an earlier run, in their folder.
    std::optional<RunLog> log_;
    std::optional<SeriesWriter> series_;
    double tenths_seen_ = 0;  ///< Of the stage's duration, at the last frame.
};

Result<void> Runner::prepare() {
    if (script_.program->stages.empty()) {
        const SourceId whole = 0;
        script_.diagnostics.error({whole, 0, 0}, "this script has no stage to run",
                                  example_of_stage(*script_.program));
        return failure("nothing to run");
    }
    outputs_ = outputs_of(script_, request_);
    if (auto good = check_request(script_, request_); !good) return good;
    auto painter = Painter::create(script_, request_.picture);
    if (!painter) return tl::unexpected(painter.error());
    painter_ = std::move(*painter);
    auto panels = panel_painters(script_, request_);
    if (!panels) return tl::unexpected(panels.error());
    panels_ = std::move(*panels);
    if (!request_.labels.empty()) {
        auto labels = FrameLabels::create(script_, request_.labels);
        if (!labels) return tl::unexpected(labels.error());
        labels_ = std::move(*labels);
    }
    if (!request_.log.expressions.empty()) {
        auto log = RunLog::create(script_, request_.log);
        if (!log) return tl::unexpected(log.error());
        log_ = std::move(*log);
    }
    // Making the cells of a model takes a while, so what is written is checked before it, too.
    if (script_.program->domain.model || request_.session) {
        if (auto good = check_places(Folders::tried); !good) return good;
    }
    if (auto made = make_simulation(); !made || report_.status == RunStatus::cancelled) return made;
    if (auto made = make_detailed(); !made || report_.status == RunStatus::cancelled) return made;
    // Folders are created last, so that a run that is refused leaves none.
    if (auto good = check_places(Folders::made); !good) return good;
    if (!request_.frames.empty()) {
        auto frames = earlier_frames(request_.frames, script_, !request_.resume.empty());
        if (!frames) return tl::unexpected(frames.error());
        earlier_frames_ = std::move(*frames);
    }
    const bool has_frames =
        !request_.frames.empty() || films_steps(request_) || request_.model_files.animate;
    if (has_frames || request_.picture.space_time) {
        auto frames = FrameRecorder::create(has_frames, request_.picture.space_time);
        if (!frames) return tl::unexpected(frames.error());
        frames_ = std::move(*frames);
    }
    if (!request_.series.empty()) {
        auto series = SeriesWriter::create(request_.series);
        if (!series) return tl::unexpected(series.error());
        series_ = std::move(*series);
    }
    keep_while_running();
    if (request_.resume.empty()) return {};
    return restore_run(request_.resume, script_, *simulation_, control_.cancel);
}

/// Checks all places to which the run will write.
Result<void> Runner::check_places(Folders folders) {
    if (auto good = check_outputs(script_, request_, outputs_); !good) return good;
    if (!request_.save.empty()) {
        if (auto good = check_savable(request_.save, script_); !good) return good;
    }
    return check_folders(request_, folders);
}

/// Saves the run periodically, so that it can be resumed if it is killed. An error of writing does
/// not end the run; saving may succeed later.
void Runner::keep_while_running() {
    if (!(request_.checkpoint_seconds > 0)) return;
    const auto between = std::chrono::duration<double>(request_.checkpoint_seconds);
    const auto kept_at = std::make_shared<Clock::time_point>(Clock::now());
    simulation_->keep_with(
        [kept_at, between] { return Clock::now() - *kept_at >= between; },
        [this, kept_at] {
            const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
            const auto written = save_run(request_.save, script_, *simulation_);
            if (!written && control_.warn) {
                control_.warn(fmt::format("the run could not be saved at {}, and continues: {}",
                                          place(), written.error().message));
            }
            *kept_at = Clock::now();
        });
}

/// Notes where the user has cancelled the run before its first step, if so.
bool Runner::has_cancelled(std::string what) {
    if (!control_.cancel) return false;
    report_.status = RunStatus::cancelled;
    report_.where = std::move(what);
    return true;
}

/// The run at the end of the session, which must be a run of the script.
Result<std::unique_ptr<LiveRun>> Runner::play_session() {
    auto played = LiveRun::play(*request_.session, script_.folder, request_.simulation, control_);
    if (!played) {
        Failure why = played.error().in_brief();
        why.message = "the session cannot be played: " + why.message;
        return tl::unexpected(std::move(why));
    }
    const Script& end = (*played)->script();
    if (end.text != script_.text || end.overrides != script_.overrides) {
        return failure("the session of the picture does not end with the script of the picture",
                       "the picture has been changed since it was written");
    }
    return std::move(*played);
}

/// Makes texture coordinates if files need them, or checks those of the model.
Result<void> Runner::find_texture(const SurfaceMesh& mesh) {
    const ModelFileOptions& files = request_.model_files;
    if (!needs_texture(mesh, files)) {
        return files.has_maps() ? check_bakeable(mesh) : Result<void>();
    }
    if (control_.report) {
        Progress progress;
        progress.doing = "making texture coordinates";
        control_.report(progress);
    }
    const int threads = request_.simulation.threads;
    Team team(threads > 0 ? threads : hardware_threads());
    const auto& model = script_.program->domain.model;
    const std::int64_t side = texture_side(files, model ? model->count : 0);
    auto made = made_texture(mesh, side, team, control_.cancel);
    if (!made) return tl::unexpected(made.error());
    texture_ = *std::move(made);
    return {};
}

/// Chooses the size of maps where it follows from the cells.
void Runner::choose_map_size() {
    ModelFileOptions& files = request_.model_files;
    if (!(files.texels_per_cell > 0)) return;
    const MapSize size = map_size_for(files.texels_per_cell, *simulation_, texture_);
    files.bake = size.side;
    const auto& say = size.is_short ? control_.warn : control_.note;
    if (say) say(size.remark);
}

/// There is no simulation if the user has cancelled it.
Result<void> Runner::make_simulation() {
    SimulationOptions options = request_.simulation;
    options.control = &control_;
    options.check_model = [this](const SurfaceMesh& mesh) { return find_texture(mesh); };
    std::unique_ptr<LiveRun> played;
    if (request_.session) {
        auto run = play_session();
        if (!run && has_cancelled("a session that is played")) return {};
        if (!run) return tl::unexpected(run.error());
        played = std::move(*run);
        options.known_model = played->simulation().model();
    }
    auto made = Simulation::create(script_, options);
    if (!made && !script_.diagnostics.has_errors() &&
        has_cancelled("the making of the model's cells")) {
        return {};
    }
    if (!made) return tl::unexpected(made.error());
    simulation_ = std::move(*made);
    if (played && simulation_->model()) {
        // It brought its model along, so that nothing has checked it yet.
        if (auto good = find_texture(simulation_->model()->mesh); !good) return good;
    }
    if (played) {
        const auto restored =
            go_on(*simulation_, nullptr, played->values(), Continuation::same, control_.cancel);
        if (!restored) return tl::unexpected(restored.error());
    }
    choose_map_size();
    auto fits = check_picture_size(script_.program->domain, request_.picture, simulation_->memory(),
                                   request_.simulation.memory_limit);
    return fits ? check_film_sizes(script_, request_) : fits;
}

Result<StageEnd> Runner::run_stage(std::uint32_t k) {
    const Stage& stage = script_.program->stages[k];
    if (!simulation_->state(k).started) {
        if (auto started = simulation_->start_stage(k, control_.cancel); !started) {
            if (control_.cancel) return StageEnd::cancelled;
            return tl::unexpected(started.error());
        }
        // Until a later stage takes a step, pictures show the stage before, which has its frame.
        if (stage.iterations > 0 && simulation_->state(*simulation_->shown_stage()).steps == 0) {
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
    tenths_seen_ = tenths_done(k);
    const auto start = Clock::now();
    auto end = simulation_->advance_stage(
        k, std::max(last, before), control_, [&] { observe(k); }, observation_interval(stage));
    report_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    report_.steps += simulation_->state(k).steps - before;
    if (log_) log_->record(*simulation_, k);
    if (stops_here && end && *end == StageEnd::finished) return StageEnd::stopped;
    return end;
}

Result<void> Runner::run_stages() {
    for (std::uint32_t k = 0; k < script_.stage_count(); ++k) {
        const std::int64_t before = simulation_->state(k).steps;
        if (before == 0) remark(outlook(simulation_->program(), k));
        auto end = run_stage(k);
        if (!end) return tl::unexpected(end.error());
        report_.where = place();
        if (*end == StageEnd::finished) {
            if (simulation_->state(k).steps > before) remark(simulation_->remark_on(k));
            continue;
        }
        report_.status = *end == StageEnd::cancelled ? RunStatus::cancelled : RunStatus::stopped;
        return {};
    }
    return {};
}

/// The finer cells of --detail.
Result<void> Runner::make_detailed() {
    if (request_.picture.detail == 1) return {};
    auto made = DetailedRun::create(script_, request_, *simulation_, control_);
    if (!made && !script_.diagnostics.has_errors() && has_cancelled("the making of finer cells"))
        return {};
    if (!made) return tl::unexpected(made.error());
    detailed_ = std::move(*made);
    return {};
}

/// Carries a run that has ended to the finer cells of --detail.
Result<void> Runner::settle_in_detail() {
    if (!detailed_ || report_.status != RunStatus::finished) return {};
    const auto start = Clock::now();
    is_detailed_ = true;
    const auto end = detailed_->settle(*simulation_, control_);
    if (!end) return tl::unexpected(end.error());
    report_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    const std::uint32_t stage = simulation_->shown_stage().value_or(0);
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

/// Remarks on stages of a resumed run that could not take more steps.
void Runner::remark_on_resumed() {
    const auto& stages = script_.program->stages;
    for (std::uint32_t k = 0; k + 1 < script_.stage_count(); ++k) {
        const StageState& state = simulation_->state(k);
        const bool is_short = state.done && !state.condition_met &&
                              !stages[k].time.has_duration() && state.steps < stages[k].iterations;
        if (!is_short || !simulation_->state(k + 1).started) continue;
        remark(fmt::format("stage '{}' stays at step {}: stage '{}' has begun from it",
                           stages[k].name, with_commas(state.steps), stages[k + 1].name));
    }
    if (report_.steps > 0 || report_.status != RunStatus::finished) return;
    remark(fmt::format("the saved run was complete already, so no steps were taken: {}", place()));
}

/// Steps between observations, such that neither a frame nor a row of the log is missed.
std::int64_t Runner::observation_interval(const Stage& stage) const {
    if (!log_) return stage.interval;
    return frames_ || series_ ? std::gcd(log_->every(stage), stage.interval) : log_->every(stage);
}

/// Frames are drawn at the stage's interval, or else at tenths of its duration.
bool Runner::frame_is_due(std::uint32_t k) {
    const std::int64_t interval = script_.program->stages[k].interval;
    if (interval > 0) return simulation_->state(k).steps % interval == 0;
    const double before = std::exchange(tenths_seen_, tenths_done(k));
    return tenths_seen_ > before;
}

double Runner::tenths_done(std::uint32_t k) const {
    const StageState& state = simulation_->state(k);
    const Program& program = *script_.program;
    return tenths_reached(state.t, duration_of(program.stages[k], program.system_of(k), state));
}

void Runner::observe(std::uint32_t k) {
    const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
    const Stage& stage = script_.program->stages[k];
    const std::int64_t step = simulation_->state(k).steps;
    if (frame_is_due(k)) look();
    const std::int64_t every = log_ ? log_->every(stage) : 0;
    if (log_ && (every == 0 || step % every == 0)) log_->record(*simulation_, k);
}

void Runner::look() {
    if (!frames_ && !series_) return;
    const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
    if (series_) series_->add(*simulation_);
    if (!frames_) return;
    const auto stage = simulation_->shown_stage().value_or(0);
    frames_->record(painter_->canvas(*simulation_), script_.program->stages[stage].name,
                    simulation_->state(stage).steps,
                    labels_ ? labels_->text(*simulation_, stage) : "");
}

std::string Runner::place() const {
    const auto stage = simulation_->shown_stage().value_or(0);
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
            series_ ? &*series_ : nullptr,
            report_};
}

Result<RunReport> Runner::run() {
    if (auto ready = prepare(); !ready) return tl::unexpected(ready.error());
    if (report_.status == RunStatus::cancelled) return std::move(report_);
    report_.has_begun = true;
    if (request_.session) {
        report_.where = place();
    } else if (auto done = run_stages(); !done) {
        // The log shows what led to the divergence.
        if (log_) (void)results().write_log();
        return tl::unexpected(done.error());
    }
    if (auto done = settle_in_detail(); !done) return tl::unexpected(done.error());
    if (!request_.resume.empty()) remark_on_resumed();
    if (report_.status == RunStatus::finished && report_.steps > 0) {
        remark(remark_on_picture(painter(), shown()));
        // A sheet draws numbers, so it uses palette and range.
        if (request_.sheet.empty()) remark(remark_on_look(painter(), shown()));
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
    if (auto written = results().write(); !written) return tl::unexpected(written.error());
    return std::move(report_);
}

}  // namespace

Result<RunReport> run(Script& script, const RunRequest& request, RunControl& control) {
    Runner runner(script, request, control);
    auto report = runner.run();
    runner.settle();
    return report;
}

}  // namespace cascade
