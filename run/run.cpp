#include "run/run.h"

#include "core/file.h"
#include "picture/vti.h"
#include "run/frames.h"
#include "run/measured.h"
#include "run/memory.h"
#include "run/png_texts.h"
#include "run/stage_time.h"

#include <fmt/format.h>

#include <chrono>
#include <deque>
#include <numeric>
#include <utility>

namespace cascade {

namespace {

using Clock = std::chrono::steady_clock;

std::filesystem::path default_output(const Script& script) {
    auto stem = std::filesystem::path(script.name).stem();
    if (stem.empty()) stem = "cascade";
    return stem.replace_extension(".png");
}

/// The log of a run goes beside its picture.
std::filesystem::path log_path(const RunRequest& request, const std::filesystem::path& output) {
    if (!request.log.file.empty()) return request.log.file;
    return std::filesystem::path(output).replace_extension(".csv");
}

/// Everything that could fail at the end of a long run is tried at its beginning.
Result<void> check_outputs(const RunRequest& request, const std::filesystem::path& output) {
    if (auto good = check_writable(output); !good) return good;
    if (!request.sheet.empty()) {
        if (request.sheet.lexically_normal() == output.lexically_normal()) {
            return failure(fmt::format("the picture and --sheet are both to be written to {}",
                                       output.string()));
        }
        if (auto good = check_writable(request.sheet); !good) return good;
    }
    if (!request.log.expressions.empty()) {
        if (auto good = check_writable(log_path(request, output)); !good) return good;
    }
    if (!request.volume.empty()) {
        if (auto good = check_writable(request.volume); !good) return good;
    }
    for (const auto& folder : {request.frames, request.save}) {
        if (folder.empty()) continue;
        if (auto made = make_folder(folder); !made) return made;
        if (auto good = check_writable(folder / "run.json"); !good) return good;
    }
    return {};
}

/// A picture larger than memory is refused before the run, not behind it. `memory` is what the run
/// takes without it.
Result<void> check_picture_size(const Grid& domain, const PictureRequest& picture, double memory,
                                std::uint64_t memory_limit) {
    constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
    const Grid grid =
        domain.depth > 1 ? slice_grid(PlaneLayout(domain), picture.slice) : domain;
    const std::int64_t pixels_per_cell = std::int64_t{picture.scale} * picture.scale;
    if (grid.cell_count() > most_pixels / pixels_per_cell) {
        return failure(fmt::format("a picture of {} × {} cells at scale {} has more than {} pixels",
                                   grid.width, grid.height, picture.scale, most_pixels),
                       "use a smaller grid or --scale");
    }
    // Painted, and then enlarged.
    const auto pixels = static_cast<double>(grid.cell_count() * (1 + pixels_per_cell));
    const double bytes = memory + pixels * sizeof(Colour);
    if (memory_limit == 0 || bytes <= static_cast<double>(memory_limit)) return {};
    return failure(fmt::format("with a picture at scale {} this run needs {}, but {} are the limit "
                               "(--limit-memory)",
                               picture.scale, describe_bytes(bytes),
                               describe_bytes(static_cast<double>(memory_limit))),
                   "use a smaller grid or --scale");
}

/// A place to stop at that the run never comes to would let it run on to its end.
void check_stop_at(Script& script, const StopAt& stop_at) {
    const std::string text = fmt::format("{}:{}", stop_at.stage, stop_at.step);
    Span span = option_span(script.sources, "--stop-at", text);
    const auto length = static_cast<std::uint32_t>(stop_at.stage.size());
    const auto stage =
        find_stage_of_option(script, stop_at.stage, {span.source, span.begin, span.begin + length});
    if (!stage) return;
    if (*stage >= script.stage_count()) {
        script.diagnostics.error(span, fmt::format("stage '{}' does not run", stop_at.stage),
                                 "--until-stage ends the run before it");
        return;
    }
    const std::int64_t iterations = script.program->stages[*stage].iterations;
    if (stop_at.step <= iterations) return;
    span.begin = length + 1;
    script.diagnostics.error(span, fmt::format("stage '{}' has {} steps", stop_at.stage, iterations));
}

/// Options of pictures that mean nothing for the domain.
void check_picture(Script& script, const PictureRequest& picture) {
    const DomainSettings& domain = script.program->domain;
    const auto refuse = [&](std::string_view option, std::string_view message, std::string_view hint) {
        script.diagnostics.error(option_span(script.sources, std::string(option), std::string(option)),
                                 std::string(message), std::string(hint));
    };
    if (picture.slice != Slice{} && domain.grid.depth == 1) {
        refuse("--slice", "a plane has no slices", "grid: W, H, D makes a volume");
    }
    if (domain.model) {
        if (picture.flat) refuse("--flat", "the cells of a model have no rows and columns", "-o model.ply, or --bake, has the pattern without light");
        return;
    }
    if (domain.surface) return;
    constexpr std::string_view hint = "surface: x, y, z in the domain makes one";
    if (picture.flat) refuse("--flat", "the domain is no surface", hint);
    if (picture.is_turned()) refuse("--view", "the domain is no surface", hint);
}

/// Outputs of rows and columns, which a model does not have.
void check_on_model(Script& script, const RunRequest& request) {
    const auto refuse = [&](bool is_asked_for, const char* option, const char* hint) {
        if (!is_asked_for) return;
        script.diagnostics.error(option_span(script.sources, option, option),
                                 "the cells of a model have no rows and columns", hint);
    };
    refuse(!request.sheet.empty(), "--sheet", "--show a draws another species");
    refuse(!request.volume.empty(), "--volume", "");
    refuse(request.features, "--features", "");
}

/// What is asked for must fit the script; where it does not, the script's diagnostics say so.
Result<void> check_request(Script& script, const RunRequest& request) {
    const std::int64_t rows = script.program->domain.grid.height * script.program->domain.grid.depth;
    if (request.picture.space_time && rows != 1) {
        script.diagnostics.error(
            option_span(script.sources, "--space-time", "--space-time"),
            fmt::format("a space-time picture is drawn of a grid of one row, not of {}", rows),
            "for a plane, --frames writes a picture each interval");
    }
    check_picture(script, request.picture);
    if (script.program->domain.model) check_on_model(script, request);
    if (request.stop_at) check_stop_at(script, *request.stop_at);
    if (script.diagnostics.has_errors()) return failure("the request does not fit the script");
    return {};
}

PngDepth depth_of(const PictureRequest& request) {
    return request.depth == 16 ? PngDepth::sixteen : PngDepth::eight;
}

/// One run from its first stage to its files.
class Runner {
public:
    Runner(Script& script, const RunRequest& request, RunControl& control)
        : script_(script), request_(request), control_(control) {}

    Result<RunReport> run();

private:
    Result<void> prepare();
    Result<void> run_stages();
    Result<StageEnd> run_stage(std::uint32_t stage);
    void look();
    void observe(std::uint32_t stage);
    bool frame_is_due(std::uint32_t stage);
    double tenths_behind(std::uint32_t stage) const;
    std::int64_t observation_interval(const Stage& stage) const;
    Result<void> write_results();
    Result<void> write_final_picture();
    Result<void> write_frames();
    Result<void> write_saved_run();
    Result<void> write_log();
    Result<void> write_volume();
    Result<void> write_picture(const std::filesystem::path& path, const Image& image);
    std::string place() const;

    Script& script_;
    const RunRequest& request_;
    RunControl& control_;
    RunReport report_;
    std::filesystem::path output_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<Painter> painter_;
    std::optional<FrameRecorder> frames_;
    std::optional<RunLog> log_;
    double tenths_seen_ = 0;  ///< Of the duration of the stage that runs, when a frame was drawn.
};

Result<void> Runner::prepare() {
    if (script_.program->stages.empty()) {
        const SourceId whole = 0;
        script_.diagnostics.error({whole, 0, 0}, "this script has no stage to run",
                                  "add one, as in 'stage spots: turing_spots { }'");
        return failure("nothing to run");
    }
    output_ = request_.output.empty() ? default_output(script_) : request_.output;
    if (auto good = check_request(script_, request_); !good) return good;
    auto painter = Painter::create(script_, request_.picture);
    if (!painter) return tl::unexpected(painter.error());
    painter_ = std::move(*painter);
    auto simulation = Simulation::create(script_, request_.simulation);
    if (!simulation) return tl::unexpected(simulation.error());
    simulation_ = std::move(*simulation);
    if (auto good = check_picture_size(simulation_->grid(), request_.picture, simulation_->memory(),
                                       request_.simulation.memory_limit);
        !good) {
        return good;
    }
    if (!request_.log.expressions.empty()) {
        auto log = RunLog::create(script_, request_.log);
        if (!log) return tl::unexpected(log.error());
        log_ = std::move(*log);
    }
    // Folders are made last, so that a run that is refused leaves none behind.
    if (auto good = check_outputs(request_, output_); !good) return good;
    if (!request_.frames.empty() || request_.picture.space_time) {
        auto frames = FrameRecorder::create(request_.frames, request_.picture.space_time);
        if (!frames) return tl::unexpected(frames.error());
        frames_ = std::move(*frames);
    }
    if (request_.resume.empty()) return {};
    return restore_run(request_.resume, script_, *simulation_);
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
    const bool stops_here = request_.stop_at && request_.stop_at->stage == stage.name &&
                            request_.stop_at->step <= last;
    if (stops_here) last = request_.stop_at->step;
    const std::int64_t before = simulation_->state(k).steps;
    tenths_seen_ = tenths_behind(k);
    const auto start = Clock::now();
    auto end = simulation_->advance_stage(k, std::max(last, before), control_,
                                          [&] { observe(k); }, observation_interval(stage));
    report_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    report_.steps += simulation_->state(k).steps - before;
    if (log_) log_->record(*simulation_, k);
    if (stops_here && end && *end == StageEnd::finished) return StageEnd::stopped;
    return end;
}

Result<void> Runner::run_stages() {
    for (std::uint32_t k = 0; k < script_.stage_count(); ++k) {
        auto end = run_stage(k);
        if (!end) return tl::unexpected(end.error());
        report_.where = place();
        if (*end == StageEnd::finished) continue;
        report_.status =
            *end == StageEnd::cancelled ? RunStatus::cancelled : RunStatus::stopped;
        return {};
    }
    return {};
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
    const double before = std::exchange(tenths_seen_, tenths_behind(k));
    return tenths_seen_ > before;
}

double Runner::tenths_behind(std::uint32_t k) const {
    const StageState& state = simulation_->state(k);
    const Program& program = *script_.program;
    return tenths_reached(state.t, duration_of(program.stages[k], program.system_of(k), state));
}

void Runner::observe(std::uint32_t k) {
    const Stage& stage = script_.program->stages[k];
    const std::int64_t step = simulation_->state(k).steps;
    if (frame_is_due(k)) look();
    const std::int64_t every = log_ ? log_->every(stage) : 0;
    if (log_ && (every == 0 || step % every == 0)) log_->record(*simulation_, k);
}

void Runner::look() {
    if (!frames_) return;
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
    auto done = write_png(path, image, depth_of(request_.picture),
                          embed_script(script_, request_.picture));
    if (done) report_.written.push_back(path);
    return done;
}

Result<void> Runner::write_final_picture() {
    return write_picture(output_, request_.picture.space_time
                                      ? frames_->space_time(*painter_)
                                      : painter_->image(painter_->canvas(*simulation_)));
}

Result<void> Runner::write_frames() {
    if (auto failed = frames_->failure()) return tl::unexpected(*failed);
    auto written = frames_->write(*painter_, depth_of(request_.picture),
                                  embed_script(script_, request_.picture));
    if (!written) return tl::unexpected(written.error());
    report_.written.insert(report_.written.end(), written->begin(), written->end());
    return {};
}

Result<void> Runner::write_log() {
    const auto path = log_path(request_, output_);
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
    // One output that fails does not cost the others: hours of stepping may lie behind them.
    std::optional<Failure> first;
    const auto attempt = [&](const Result<void>& done) {
        if (!done && !first) first = done.error();
    };
    attempt(write_final_picture());
    if (log_) attempt(write_log());
    if (!request_.frames.empty()) attempt(write_frames());
    if (!request_.sheet.empty()) {
        attempt(write_picture(request_.sheet, draw_sheet(*simulation_, request_.picture)));
    }
    if (!request_.volume.empty()) attempt(write_volume());
    if (!request_.save.empty()) attempt(write_saved_run());
    if (painter_->fell_back() && control_.warn) {
        control_.warn("where the picture names a stage that has not run, the default picture is "
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
    if (auto done = run_stages(); !done) {
        // What led to a blow-up is what one wants to see of it.
        if (log_) (void)write_log();
        return tl::unexpected(done.error());
    }
    if (request_.features) {
        report_.features = measure_shown(*painter_, *simulation_);
    }
    if (auto written = write_results(); !written) return tl::unexpected(written.error());
    return std::move(report_);
}

}  // namespace

Result<RunReport> run(Script& script, const RunRequest& request, RunControl& control) {
    return Runner(script, request, control).run();
}

}  // namespace cascade
