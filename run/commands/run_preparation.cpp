// Checks and makes everything that is needed before the first step.
#include "run/commands/runner.h"

#include "export/bake.h"
#include "run/commands/series_fields.h"
#include "run/pictures/frame_folder.h"
#include "run/pictures/map_size.h"
#include "run/pictures/picture_size.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

Result<void> Runner::prepare() {
    if (script_.program->stages.empty()) {
        const SourceId whole = 0;
        script_.diagnostics.error({whole, 0, 0}, "this script has no stage to run",
                                  example_of_stage(*script_.program));
        return failure("nothing to run");
    }
    outputs_ = outputs_of(script_, request_);
    if (auto good = check_request(script_, request_); !good) return good;
    moments_ = *moments_in(script_.tree, request_.moments);
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
        auto log = RunLog::create(script_, request_.log, request_.picture);
        if (!log) return tl::unexpected(log.error());
        log_ = std::move(*log);
    }
    Result<SeriesFields> fields = SeriesFields();
    if (!request_.series.empty()) fields = series_fields(script_, request_, *painter_);
    if (!fields) return tl::unexpected(fields.error());
    // Making the cells of a model takes a while, so outputs are checked here for the first time.
    if (script_.program->domain.model || writes_one_moment(request_)) {
        if (auto good = check_places(Folders::tried); !good) return good;
    }
    if (auto made = make_simulation(); !made || report_.status == RunStatus::cancelled) return made;
    if (auto made = make_detailed(); !made || report_.status == RunStatus::cancelled) return made;
    choose_map_size();
    // Folders are created last, so that a run that is refused leaves no folders.
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
        auto series = make_series(request_.series, *std::move(fields), !request_.resume.empty());
        if (!series) return tl::unexpected(series.error());
        series_ = *std::move(series);
    }
    keep_while_running();
    if (request_.resume.empty()) return {};
    return restore_run(request_.resume, script_, *simulation_, control_.cancel);
}

/// Checks all files and folders to which the run will write.
Result<void> Runner::check_places(Folders folders) {
    if (auto good = check_outputs(script_, request_, outputs_); !good) return good;
    if (!request_.save.empty()) {
        if (auto good = check_savable(request_.save, script_); !good) return good;
    }
    return check_folders(request_, folders);
}

/// Saves the run at regular intervals, so that it can be resumed if it is killed. If a save fails,
/// the run continues, because a later save may succeed.
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
                control_.warn(
                    fmt::format("the run continues, although its state could not be saved at {}: "
                                "{}",
                                place(), written.error().message));
            }
            *kept_at = Clock::now();
        });
}

/// If the user has cancelled the run before its first step, records this in the report and returns
/// true. `what` says what was being done.
bool Runner::has_cancelled(std::string what) {
    if (!control_.cancel) return false;
    report_.status = RunStatus::cancelled;
    report_.where = std::move(what);
    return true;
}

/// Repeats the session and returns the live run at its end. The session must belong to this script.
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

/// Makes texture coordinates for the model if files need them and the model has none. Otherwise
/// checks whether maps can be made with the model's own coordinates.
Result<void> Runner::find_texture(const SurfaceMesh& mesh) {
    const ModelFileOptions& files = request_.model_files;
    if (!needs_texture(mesh, files)) {
        if (!files.has_maps()) return {};
        BakeOptions usual;
        const double side = static_cast<double>(usual.samples * files.bake);
        return check_bakeable(mesh, files.bake > 0 ? side * side : most_samples);
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

/// Computes the size of maps if the user has given it as texels for each cell.
void Runner::choose_map_size() {
    ModelFileOptions& files = request_.model_files;
    if (!(files.texels_per_cell > 0)) return;
    const Simulation& shown = detailed_ ? detailed_->simulation() : *simulation_;
    const MapSize size = map_size_for(files.texels_per_cell, shown, texture_);
    files.bake = size.side;
    const auto& say = size.is_short ? control_.warn : control_.note;
    if (say) say(size.remark);
}

/// Makes the simulation. If the user cancels, makes none and returns without an error.
Result<void> Runner::make_simulation() {
    SimulationOptions options = request_.simulation;
    options.control = &control_;
    options.check_model = [this](const SurfaceMesh& mesh) { return find_texture(mesh); };
    std::unique_ptr<LiveRun> played;
    const LiveRun* present = request_.present;
    if (present == nullptr && request_.session) {
        auto run = play_session();
        if (!run && has_cancelled("a session that is played")) return {};
        if (!run) return tl::unexpected(run.error());
        played = std::move(*run);
        present = played.get();
    }
    if (present) {
        options.known_model = present->simulation().domain().shared_model();
        options.known_sizes = present->simulation().domain().known_sizes;
    }
    auto made = Simulation::create(script_, options);
    const char* const doing =
        script_.program->domain.model ? "making the model's cells" : "the trials of 'size'";
    if (!made && !script_.diagnostics.has_errors() && has_cancelled(doing)) return {};
    if (!made) return tl::unexpected(made.error());
    simulation_ = std::move(*made);
    if (present && simulation_->domain().model) {
        // The session has loaded its own model, whose texture coordinates have not been checked
        // yet.
        if (auto good = find_texture(simulation_->domain().model->cells->mesh); !good) return good;
    }
    if (present) {
        const auto restored =
            go_on(*simulation_, nullptr, present->values(), Continuation::same, control_.cancel);
        if (!restored) return tl::unexpected(restored.error());
    }
    auto fits = check_picture_size(script_, request_.picture, simulation_->domain().memory,
                                   request_.simulation.memory_limit);
    if (fits) fits = check_film_sizes(script_, request_, control_.cancel);
    if (!fits && has_cancelled("the trial of ffmpeg")) return {};
    return fits;
}

/// Makes the smaller cells of --detail.
Result<void> Runner::make_detailed() {
    if (request_.picture.detail == 1) return {};
    auto made = DetailedRun::create(script_, request_, *simulation_, control_);
    if (!made && !script_.diagnostics.has_errors() && has_cancelled("making finer cells"))
        return {};
    if (!made) return tl::unexpected(made.error());
    detailed_ = std::move(*made);
    return {};
}

}  // namespace cascade
