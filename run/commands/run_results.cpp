// Writes each output of a run, even if another output fails.
#include "run/commands/run_results.h"

#include "core/counted.h"
#include "core/file_format.h"
#include "run/commands/film_crew.h"
#include "run/commands/run_checks.h"
#include "run/pictures/frame_folder.h"
#include "run/pictures/model_picture.h"
#include "run/script/embedded_script.h"
#include "run/session/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {

PngTexts RunResults::texts(const PictureRequest& picture) const {
    return request.session ? embed_session(script, picture, *request.session)
                           : embed_script(script, picture);
}

Result<void> RunResults::write_picture(const std::filesystem::path& path, const Image& image) {
    auto done = write_png(path, image, request.picture.png_depth(), texts(painter.request()));
    if (done) report.written.push_back(path);
    return done;
}

bool RunResults::has(FormatKind kind) const {
    return std::any_of(outputs.begin(), outputs.end(), [&](const auto& output) {
        return output_kind(output).value_or(FormatKind::picture) == kind;
    });
}

/// Whether a file with this path contains a model or cells.
static bool is_of_model(const std::filesystem::path& output) {
    const auto kind = output_kind(output);
    return kind == FormatKind::model || kind == FormatKind::cells;
}

void RunResults::say(std::string what) const {
    if (!control.report) return;
    Progress progress;
    progress.doing = std::move(what);
    control.report(progress);
}

void RunResults::note_stop(const std::string& where) {
    const bool has_stopped =
        std::exchange(report.status, RunStatus::cancelled) == RunStatus::cancelled;
    report.where = has_stopped ? fmt::format("{}, and at {}", report.where, where) : where;
}

/// Returns whether an output must be left out because the program must end. If so, adds a note
/// about the output.
bool RunResults::is_left_out(const std::string& what) {
    if (control.hurry) note_stop(what);
    return control.hurry;
}

std::optional<Image> RunResults::drawn(const Canvas& canvas, const std::string& what,
                                       const std::filesystem::path& path) {
    say(what);
    int last = 0;
    bool is_whole = true;
    painter.set_report([&](double part) {
        const int percent = static_cast<int>(100 * part);
        if (percent != std::exchange(last, percent)) say(fmt::format("{}, {} %", what, percent));
        is_whole = part == 1 || !stop();
        return is_whole;
    });
    Image image = painter.image(canvas);
    painter.set_report({});
    if (is_whole) return image;
    note_stop(fmt::format("the drawing of {}", path.string()));
    return std::nullopt;
}

Result<void> RunResults::write_final_picture(const std::filesystem::path& path,
                                             const Canvas& canvas) {
    if (request.turntable > 0) return write_turntable(path, canvas);
    if (request.picture.space_time) return write_picture(path, frames->space_time(painter));
    if (is_left_out(fmt::format("the drawing of {}", path.string()))) return {};
    const auto image = drawn(canvas, "drawing the picture", path);
    return image ? write_picture(path, *image) : Result<void>();
}

/// Returns the direction of view of picture `number` in a turntable of `count` pictures.
View RunResults::turned_view(std::size_t number, std::size_t count) const {
    View view = request.picture.view;
    view.is_turning = true;
    const double turn = 360.0 * static_cast<double>(number) / static_cast<double>(count);
    view.azimuth =
        static_cast<float>(std::remainder(static_cast<double>(view.azimuth) + turn, 360.0));
    return view;
}

Result<void> RunResults::write_turntable(const std::filesystem::path& path, const Canvas& canvas) {
    Result<void> done;
    const auto paths = turntable_paths(path, request.turntable);
    for (std::size_t k = 0; k < paths.size() && done; ++k) {
        painter.set_view(turned_view(k, paths.size()));
        const auto image =
            drawn(canvas, fmt::format("drawing {} of {}", k + 1, paths.size()), paths[k]);
        if (!image) break;
        done = write_picture(paths[k], *image);
    }
    painter.set_view(request.picture.view);
    return done;
}

/// Whether the picture shows the number that the option --show selects.
bool RunResults::shows_number(const Canvas& canvas) const {
    return !request.picture.show.empty() && !canvas.is_colour();
}

void RunResults::warn_of(const std::vector<std::string>& warnings) const {
    for (const std::string& warning : warnings) {
        if (control.warn) control.warn(warning);
    }
}

/// Writes each model and each file of cells, even if another file fails.
Result<void> RunResults::write_each(const FileWriter& write_one) {
    std::optional<Failure> first;
    for (const auto& output : outputs) {
        if (!is_of_model(output)) continue;
        if (is_left_out(fmt::format("the writing of {}", output.string()))) continue;
        say(fmt::format("writing {}", output.filename().string()));
        const auto written = write_one(output);
        if (!written) {
            if (!first) first = written.error();
            continue;
        }
        report.written.insert(report.written.end(), written->paths.begin(), written->paths.end());
        report.notes.insert(report.notes.end(), written->notes.begin(), written->notes.end());
        warn_of(written->warnings);
    }
    if (first) return tl::unexpected(*first);
    return {};
}

/// Writes the files of a model, crawling cells, a body, a plane or a slice of a volume.
Result<void> RunResults::write_shown_files(const Canvas& canvas) {
    const FileWriter write = writer_of({simulation, painter, canvas, texture, request.model_files,
                                        texts(request.picture), shows_number(canvas)});
    const bool is_model = !canvas.cells && simulation.domain().model;
    return write_each([&](const std::filesystem::path& path) -> Result<WrittenFiles> {
        if (!is_model || !request.model_files.is_animated(path)) return write(path);
        if (auto done = write_growth(path); !done) return tl::unexpected(done.error());
        return WrittenFiles{{path}, {}};
    });
}

/// Writes a model that shows all frames of the run. The colours of all frames cover the same range.
Result<void> RunResults::write_growth(const std::filesystem::path& path) {
    if (auto failed = frames->failure()) return tl::unexpected(*failed);
    if (frames->count() == 0) {
        return failure(fmt::format("'{}' has no moments, because the run took no step",
                                   path.string()),
                       "a moment is written at the start of a stage and at each 'interval'");
    }
    FilmPlan plan = film_plan(request.film, frames->count(), false, ModelGrowth::most);
    const auto look_of = [&](std::size_t k) -> Result<ModelLook> {
        const auto canvas = frames->canvas(plan.frames[k]);
        if (!canvas) return tl::unexpected(canvas.error());
        return painter.look(*canvas, frames->range());
    };
    const auto last = look_of(plan.frames.size() - 1);
    if (!last) return tl::unexpected(last.error());
    return write_growing_model(path, *simulation.domain().model->cells, texture, *last,
                               {plan.frames.size(), look_of, 1 / plan.frames_per_second});
}

Result<void> RunResults::write_outputs(const Canvas& canvas) {
    Result<void> result;
    for (const auto& output : outputs) {
        const FormatKind kind = output_kind(output).value_or(FormatKind::picture);
        if (kind != FormatKind::picture && kind != FormatKind::figure) continue;
        auto done = kind == FormatKind::figure ? write_figure(output, canvas)
                                               : write_final_picture(output, canvas);
        if (result) result = done;
    }
    if (has(FormatKind::film)) {
        auto done = write_films(canvas);
        if (result) result = done;
    }
    if (!has(FormatKind::model) && !has(FormatKind::cells)) return result;
    const auto done = write_shown_files(canvas);
    return result ? done : result;
}

/// Returns how many frames are drawn at the same time. If memory is limited, only one, because the
/// estimate of memory includes only one picture.
int RunResults::drawing_threads() const {
    const SimulationOptions& options = request.simulation;
    if (options.memory_limit > 0) return 1;
    return options.threads > 0 ? options.threads : hardware_threads();
}

Result<void> RunResults::write_frames() {
    if (auto failed = frames->failure()) return tl::unexpected(*failed);
    auto written = frames->write(request.frames, painter, texts(request.picture), drawing_threads(),
                                 control.hurry);
    if (!written) return tl::unexpected(written.error());
    if (written->size() < frames->count()) {
        note_stop(fmt::format("frame {} of {} in {}", written->size(), frames->count(),
                              request.frames.string()));
    }
    report.written.insert(report.written.end(), written->begin(), written->end());
    if (const std::size_t stale = remove_stale_frames(earlier_frames, *written);
        stale > 0 && control.note) {
        control.note(fmt::format("removed {} of an earlier run from {}",
                                 counted(static_cast<std::int64_t>(stale), "frame"),
                                 request.frames.string()));
    }
    return {};
}

Result<void> RunResults::write_log() {
    const auto path = log_path(request, outputs[0]);
    auto written = log->write(path);
    if (written) report.written.push_back(path);
    return written;
}

Result<void> RunResults::save() {
    if (request.save.empty()) return {};
    const TimeAccount::Scope spent(request.simulation.account, Spent::drawing);
    auto written = save_run(request.save, own.script, own.simulation);
    if (!written) return tl::unexpected(written.error());
    return {};
}

Result<void> RunResults::write_volume() {
    auto done = cascade::write_volume(request.volume, simulation, texts(request.picture));
    if (done) report.written.push_back(request.volume);
    return done;
}

Result<void> RunResults::write_series() {
    const auto written = series->finish();
    if (!written) return tl::unexpected(written.error());
    report.written.insert(report.written.end(), written->paths.begin(), written->paths.end());
    if (written->removed > 0 && control.note) {
        control.note(fmt::format("removed {} of an earlier run beside {}",
                                 counted(static_cast<std::int64_t>(written->removed), "file"),
                                 request.series.string()));
    }
    return {};
}

/// Writes the log, the volume and the series.
Result<void> RunResults::write_numbers() {
    Result<void> result;
    const auto attempt = [&](const Result<void>& done) {
        if (result) result = done;
    };
    if (log) attempt(write_log());
    if (!request.volume.empty()) attempt(write_volume());
    if (series) attempt(write_series());
    return result;
}

RunResults::Early RunResults::write_early() {
    Early early;
    early.saved = save();
    early.has_numbers = report.status == RunStatus::cancelled;
    if (early.has_numbers) early.numbers = write_numbers();
    return early;
}

Result<void> RunResults::write(const Canvas& canvas, const Early& early) {
    const TimeAccount::Scope spent(request.simulation.account, Spent::drawing);
    // The run may have taken hours, so an output is written even if another one has failed.
    std::optional<Failure> first;
    const auto attempt = [&](const Result<void>& done) {
        if (!done && !first) first = done.error();
    };
    attempt(write_outputs(canvas));
    if (!request.frames.empty()) attempt(write_frames());
    if (!request.sheet.empty() &&
        !is_left_out(fmt::format("the drawing of {}", request.sheet.string()))) {
        attempt(write_picture(request.sheet, draw_sheet(simulation, request.picture)));
    }
    attempt(early.has_numbers ? early.numbers : write_numbers());
    attempt(early.saved);
    if (!request.save.empty() && early.saved) report.written.push_back(request.save);
    if (painter.fell_back() && control.warn) {
        control.warn(
            "the picture reads a stage that has not run, so the default picture is drawn instead");
    }
    if (!first) return {};
    if (!report.written.empty()) {
        first->hint += fmt::format("{}written all the same: {}", first->hint.empty() ? "" : "; ",
                                   report.written.back().string());
    }
    return tl::unexpected(*first);
}

}  // namespace cascade
