// The order of a run: what can be refused is refused first, then the stages run, then each output
// is tried, so that one that fails costs no other.
#include "run/commands/run.h"

#include "core/counted.h"
#include "core/with_commas.h"
#include "export/bake.h"
#include "picture/vti.h"
#include "run/commands/run_checks.h"
#include "run/pictures/frame_folder.h"
#include "run/pictures/frames.h"
#include "run/pictures/measured.h"
#include "run/pictures/model_files.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/picture_remarks.h"
#include "run/script/embedded_script.h"
#include "run/stage/stage_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <numeric>
#include <utility>

namespace cascade {

namespace {

using Clock = std::chrono::steady_clock;

/// One run from its first stage to its files.
class Runner {
public:
    Runner(Script& script, const RunRequest& request, RunControl& control)
        : script_(script), request_(request), control_(control) {}

    Result<RunReport> run();
    /// Says what turned out only when its stage was over.
    void settle() {
        if (simulation_) simulation_->settle(control_);
    }

private:
    Result<void> prepare();
    Result<void> make_simulation();
    Result<void> run_stages();
    Result<StageEnd> run_stage(std::uint32_t stage);
    void remark(std::string words);
    void remark_on_resumed();
    void look();
    void observe(std::uint32_t stage);
    bool frame_is_due(std::uint32_t stage);
    double tenths_done(std::uint32_t stage) const;
    std::int64_t observation_interval(const Stage& stage) const;
    Result<void> write_results();
    Result<void> write_outputs();
    Result<void> write_final_picture(const std::filesystem::path& path, const Canvas& canvas);
    Result<void> write_turntable(const std::filesystem::path& path, const Canvas& canvas);
    Result<void> write_model_files(const Canvas& canvas);
    std::vector<Channel> channels(const Canvas& canvas) const;
    bool has(OutputKind kind) const;
    void say(std::string what) const;
    Result<void> write_frames();
    Result<void> write_saved_run();
    void keep_while_running();
    Result<void> write_log();
    Result<void> write_volume();
    Result<void> write_picture(const std::filesystem::path& path, const Image& image);
    std::string place() const;

    Script& script_;
    const RunRequest& request_;
    RunControl& control_;
    RunReport report_;
    std::vector<std::filesystem::path> outputs_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<Painter> painter_;
    std::optional<FrameRecorder> frames_;
    std::vector<std::filesystem::path> earlier_frames_;  ///< In their folder, of an earlier run.
    std::optional<RunLog> log_;
    double tenths_seen_ = 0;  ///< Of the duration of the stage that runs, when a frame was drawn.
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
    // Cells of a model take a while.
    if (script_.program->domain.model) {
        if (auto good = check_outputs(request_, outputs_); !good) return good;
    }
    if (auto made = make_simulation(); !made || !simulation_) return made;
    if (!request_.log.expressions.empty()) {
        auto log = RunLog::create(script_, request_.log);
        if (!log) return tl::unexpected(log.error());
        log_ = std::move(*log);
    }
    // Folders are made last, so that a run that is refused leaves none behind.
    if (auto good = check_outputs(request_, outputs_); !good) return good;
    if (!request_.save.empty()) {
        if (auto good = check_savable(request_.save, script_); !good) return good;
    }
    if (auto good = check_folders(request_); !good) return good;
    if (!request_.frames.empty()) {
        auto frames = earlier_frames(request_.frames, script_, !request_.resume.empty());
        if (!frames) return tl::unexpected(frames.error());
        earlier_frames_ = std::move(*frames);
    }
    if (!request_.frames.empty() || request_.picture.space_time) {
        auto frames = FrameRecorder::create(request_.frames, request_.picture.space_time);
        if (!frames) return tl::unexpected(frames.error());
        frames_ = std::move(*frames);
    }
    keep_while_running();
    if (request_.resume.empty()) return {};
    return restore_run(request_.resume, script_, *simulation_);
}

/// Saves the run now and then, so that one that is killed goes on from there. What cannot be
/// written then does not end the run; it may be possible later.
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
                control_.warn(fmt::format("the run could not be kept at {}, and goes on: {}",
                                          place(), written.error().message));
            }
            *kept_at = Clock::now();
        });
}

/// There is none where the user has stopped it.
Result<void> Runner::make_simulation() {
    SimulationOptions options = request_.simulation;
    options.control = &control_;
    auto made = Simulation::create(script_, options);
    if (!made && control_.cancel && !script_.diagnostics.has_errors()) {
        report_.status = RunStatus::cancelled;
        report_.where = "the making of the model's cells";
        return {};
    }
    if (!made) return tl::unexpected(made.error());
    simulation_ = std::move(*made);
    if (request_.model_files.bake > 0) {
        if (auto good = check_bakeable(simulation_->model()->mesh); !good) return good;
    }
    return check_picture_size(script_.program->domain, request_.picture, simulation_->memory(),
                              request_.simulation.memory_limit);
}

Result<StageEnd> Runner::run_stage(std::uint32_t k) {
    const Stage& stage = script_.program->stages[k];
    if (!simulation_->state(k).started) {
        if (auto started = simulation_->start_stage(k); !started) {
            return tl::unexpected(started.error());
        }
        // A later stage's start shows what the frame before it shows: the stage that ran.
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

void Runner::remark(std::string words) {
    if (words.empty()) return;
    if (control_.warn) control_.warn(words);
    report_.remarks.push_back(std::move(words));
}

/// What a larger --steps could not lengthen.
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
    remark(fmt::format("the saved run had come to its end, and no step was left to take: {}",
                       place()));
}

/// So many steps apart that neither a frame nor a row of the log is missed.
std::int64_t Runner::observation_interval(const Stage& stage) const {
    if (!log_) return stage.interval;
    return frames_ ? std::gcd(log_->every(stage), stage.interval) : log_->every(stage);
}

/// Frames have the stage's own interval, or are drawn at tenths of its duration.
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
    if (!frames_) return;
    const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
    const auto stage = simulation_->shown_stage().value_or(0);
    frames_->record(painter_->canvas(*simulation_), script_.program->stages[stage].name,
                    simulation_->state(stage).steps);
}

std::string Runner::place() const {
    const auto stage = simulation_->shown_stage().value_or(0);
    const Stage& at = script_.program->stages[stage];
    return fmt::format("stage '{}', {}", at.name, describe_place(at, simulation_->state(stage)));
}

Result<void> Runner::write_picture(const std::filesystem::path& path, const Image& image) {
    auto done = write_png(path, image, request_.picture.png_depth(),
                          embed_script(script_, painter_->request()));
    if (done) report_.written.push_back(path);
    return done;
}

bool Runner::has(OutputKind kind) const {
    return std::any_of(outputs_.begin(), outputs_.end(), [&](const auto& output) {
        return output_kind(output).value_or(OutputKind::picture) == kind;
    });
}

void Runner::say(std::string what) const {
    if (!control_.report) return;
    Progress progress;
    progress.doing = std::move(what);
    control_.report(progress);
}

Result<void> Runner::write_final_picture(const std::filesystem::path& path, const Canvas& canvas) {
    if (request_.turntable > 0) return write_turntable(path, canvas);
    return write_picture(path, request_.picture.space_time ? frames_->space_time(*painter_)
                                                           : painter_->image(canvas));
}

Result<void> Runner::write_turntable(const std::filesystem::path& path, const Canvas& canvas) {
    View view = request_.picture.view;
    view.is_turning = true;
    const float first = view.azimuth;
    Result<void> done;
    const auto paths = turntable_paths(path, request_.turntable);
    for (std::size_t k = 0; k < paths.size() && done; ++k) {
        say(fmt::format("drawing {} of {}", k + 1, paths.size()));
        const double turn = 360.0 * static_cast<double>(k) / static_cast<double>(paths.size());
        view.azimuth = static_cast<float>(std::remainder(static_cast<double>(first) + turn, 360.0));
        painter_->set_view(view);
        done = write_picture(paths[k], painter_->image(canvas));
    }
    painter_->set_view(request_.picture.view);
    return done;
}

/// The numbers that go into files of models: the species of the stage that is shown, and what
/// --show asks for.
std::vector<Channel> Runner::channels(const Canvas& canvas) const {
    const ModelCells& model = *simulation_->model();
    std::vector<Channel> channels;
    const auto add = [&](std::string name, const Field& field) {
        const std::vector<double> values = cell_values(field, model);
        channels.push_back({std::move(name), std::vector<float>(values.begin(), values.end())});
    };
    const std::uint32_t stage = simulation_->shown_stage().value_or(0);
    const System& system = script_.program->system_of(stage);
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (!system.is_species(item)) continue;
        add(std::string(system.item_name(item)), simulation_->state(stage).field(item));
    }
    if (!request_.picture.show.empty() && !canvas.is_colour()) add("shown", canvas.fields[0]);
    return channels;
}

Result<void> Runner::write_model_files(const Canvas& canvas) {
    const ModelLook look = painter_->look(canvas);
    ModelFileWriter writer(*simulation_->model(), look, channels(canvas), request_.model_files,
                           embed_script(script_, request_.picture));
    std::optional<Failure> first;
    for (const auto& output : outputs_) {
        if (output_kind(output).value_or(OutputKind::picture) == OutputKind::picture) continue;
        say(fmt::format("writing {}", output.filename().string()));
        auto written = writer.write(output);
        if (written)
            report_.written.insert(report_.written.end(), written->begin(), written->end());
        else if (!first) first = written.error();
    }
    for (const std::string& warning : writer.warnings()) {
        if (control_.warn) control_.warn(warning);
    }
    if (first) return tl::unexpected(*first);
    return {};
}

/// What -o asks for.
Result<void> Runner::write_outputs() {
    const Canvas canvas = painter_->canvas(*simulation_);
    Result<void> result;
    for (const auto& output : outputs_) {
        if (output_kind(output).value_or(OutputKind::picture) != OutputKind::picture) continue;
        auto done = write_final_picture(output, canvas);
        if (result) result = done;
    }
    if (!has(OutputKind::model) && !has(OutputKind::cells)) return result;
    auto done = write_model_files(canvas);
    return result ? done : result;
}

Result<void> Runner::write_frames() {
    if (auto failed = frames_->failure()) return tl::unexpected(*failed);
    auto written = frames_->write(*painter_, request_.picture.png_depth(),
                                  embed_script(script_, request_.picture));
    if (!written) return tl::unexpected(written.error());
    report_.written.insert(report_.written.end(), written->begin(), written->end());
    if (const std::size_t stale = remove_stale_frames(earlier_frames_, *written);
        stale > 0 && control_.note) {
        control_.note(fmt::format("removed {} of an earlier run from {}",
                                  counted(static_cast<std::int64_t>(stale), "frame"),
                                  request_.frames.string()));
    }
    return {};
}

Result<void> Runner::write_log() {
    const auto path = log_path(request_, outputs_[0]);
    auto written = log_->write(path);
    if (written) report_.written.push_back(path);
    return written;
}

Result<void> Runner::write_saved_run() {
    auto written = save_run(request_.save, script_, *simulation_);
    if (!written) return tl::unexpected(written.error());
    report_.written.push_back(request_.save);
    return {};
}

/// The species of the stage that is shown.
Result<void> Runner::write_volume() {
    const std::uint32_t stage = simulation_->shown_stage().value_or(0);
    const System& system = script_.program->system_of(stage);
    const DomainMask* mask = simulation_->mask();
    std::deque<Field> copies;
    std::vector<VolumeArray> arrays;
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (!system.is_species(item)) continue;
        const Field& field = simulation_->state(stage).field(item);
        if (mask) copies.push_back(with_outside(field, *mask, nothing_outside));
        arrays.push_back({std::string(system.item_name(item)), mask ? &copies.back() : &field});
    }
    auto done = write_vti(request_.volume, arrays, simulation_->grid().spacing,
                          mask ? &mask->inside : nullptr);
    if (done) report_.written.push_back(request_.volume);
    return done;
}

Result<void> Runner::write_results() {
    const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
    // One output that fails does not cost the others: hours of stepping may lie behind them.
    std::optional<Failure> first;
    const auto attempt = [&](const Result<void>& done) {
        if (!done && !first) first = done.error();
    };
    attempt(write_outputs());
    if (log_) attempt(write_log());
    if (!request_.frames.empty()) attempt(write_frames());
    if (!request_.sheet.empty()) {
        attempt(write_picture(request_.sheet, draw_sheet(*simulation_, request_.picture)));
    }
    if (!request_.volume.empty()) attempt(write_volume());
    if (!request_.save.empty()) attempt(write_saved_run());
    if (painter_->fell_back() && control_.warn) {
        control_.warn(
            "where the picture names a stage that has not run, the default picture is "
            "drawn instead");
    }
    if (!first) return {};
    if (!report_.written.empty()) {
        first->hint += fmt::format("{}written all the same: {}", first->hint.empty() ? "" : "; ",
                                   report_.written.back().string());
    }
    return tl::unexpected(*first);
}

Result<RunReport> Runner::run() {
    if (auto ready = prepare(); !ready) return tl::unexpected(ready.error());
    if (!simulation_) return std::move(report_);
    report_.has_begun = true;
    if (auto done = run_stages(); !done) {
        // What led to a blow-up is what one wants to see of it.
        if (log_) (void)write_log();
        return tl::unexpected(done.error());
    }
    if (!request_.resume.empty()) remark_on_resumed();
    if (report_.status == RunStatus::finished && report_.steps > 0) {
        remark(remark_on_picture(*painter_, *simulation_));
        // A sheet draws numbers.
        if (request_.sheet.empty()) remark(remark_on_look(*painter_, *simulation_));
        if (frames_ && frames_->holds_starts_alone()) {
            remark(fmt::format(
                "{} nothing but starting values: 'interval' is longer than each stage",
                request_.frames.empty() ? "the space-time picture shows" : "the frames show"));
        }
    }
    if (request_.features) {
        const TimeAccount::Scope spent(request_.simulation.account, Spent::drawing);
        report_.features = measure_shown(*painter_, *simulation_);
    }
    if (auto written = write_results(); !written) return tl::unexpected(written.error());
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
