// Writes each output of a run, even if another one fails.
#include "run/commands/run_results.h"

#include "core/counted.h"
#include "core/file_format.h"
#include "run/commands/film_crew.h"
#include "run/commands/run_checks.h"
#include "run/pictures/body_picture.h"
#include "run/pictures/cell_files.h"
#include "run/pictures/frame_folder.h"
#include "run/pictures/grid_files.h"
#include "run/pictures/model_files.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/plane_look.h"
#include "run/script/embedded_script.h"
#include "run/session/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// True for models and cells.
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

void RunResults::note_stop(std::string where) {
    report.status = RunStatus::cancelled;
    report.where = std::move(where);
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
    const auto image = drawn(canvas, "drawing the picture", path);
    return image ? write_picture(path, *image) : Result<void>();
}

/// The view of a picture of a turntable.
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

/// Has --show asked for a number?
bool RunResults::shows_number(const Canvas& canvas) const {
    return !request.picture.show.empty() && !canvas.is_colour();
}

/// The channels of model files: the species of the stage that is shown, and the number of --show.
std::vector<Channel> RunResults::channels(const Canvas& canvas) const {
    const ModelCells& model = *simulation.domain().model->cells;
    const auto numbers = [&](const Field& field) { return numbers_of_cells(field, model); };
    std::vector<Channel> channels = species_channels(simulation, numbers);
    if (shows_number(canvas)) channels.push_back({"shown", numbers(canvas.fields[0])});
    return channels;
}

void RunResults::warn_of(const std::vector<std::string>& warnings) const {
    for (const std::string& warning : warnings) {
        if (control.warn) control.warn(warning);
    }
}

/// Writes each model and each file of cells, even if another one fails.
Result<void> RunResults::write_each(
    const std::function<Result<WrittenFiles>(const std::filesystem::path&)>& write_one) {
    std::optional<Failure> first;
    for (const auto& output : outputs) {
        if (!is_of_model(output)) continue;
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

Result<void> RunResults::write_model_files(const Canvas& canvas) {
    const ModelLook look = painter.look(canvas);
    ModelFileWriter writer(*simulation.domain().model->cells, texture, look, channels(canvas),
                           request.model_files, texts(request.picture));
    return write_each([&](const std::filesystem::path& path) -> Result<WrittenFiles> {
        if (!request.model_files.is_animated(path)) return writer.write(path);
        if (auto done = write_growth(path); !done) return tl::unexpected(done.error());
        return WrittenFiles{{path}, {}};
    });
}

/// Of a model, by the frames of the run, in one range.
Result<void> RunResults::write_growth(const std::filesystem::path& path) {
    if (auto failed = frames->failure()) return tl::unexpected(*failed);
    if (frames->count() == 0) {
        return failure(fmt::format("'{}' has no moments, because the run took no step",
                                   path.string()),
                       "there is one at the start of a stage and at each 'interval'");
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

/// The files of cells that crawl.
Result<void> RunResults::write_cell_files(const Canvas& canvas) {
    const std::vector<Colour> colours = painter.colours_of_row(canvas);
    const GrownCells cells{simulation, shown_stage(simulation), *canvas.cells, colours};
    return write_each([&](const std::filesystem::path& path) {
        return write_cells(path, cells, texture, request.model_files, texts(request.picture));
    });
}

/// Of a volume whose picture is a body.
Result<void> RunResults::write_body_files(const Canvas& canvas) {
    const SurfaceMesh& body = *canvas.body;
    const Grid& grid = simulation.domain().grid;
    const auto numbers = [&](const Field& row) {
        return std::vector<float>(row.row(0), row.row(0) + body.points.size());
    };
    std::vector<Channel> channels = species_channels(simulation, [&](const Field& field) {
        return numbers(at_points(field, body, grid.boundary));
    });
    if (shows_number(canvas)) channels.push_back({"shown", numbers(canvas.fields[0])});
    const std::vector<Colour> colours = painter.colours_of_row(canvas);
    return write_each([&](const std::filesystem::path& path) {
        return write_body(path, body, grid, {colours, channels}, request.model_files.levels);
    });
}

/// Of a plane, or a slice of a volume.
Result<void> RunResults::write_plane_files(const Canvas& canvas) {
    const PlaneLook look =
        painter.plane_look(painter.map_canvas(simulation, request.model_files.bake),
                           painter.range_of(canvas));
    return write_each([&](const std::filesystem::path& path) {
        return write_plane(path, look, request.model_files, texts(request.picture));
    });
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
    Result<void> done;
    if (canvas.cells) {
        done = write_cell_files(canvas);
    } else if (simulation.domain().model) {
        done = write_model_files(canvas);
    } else if (canvas.body) {
        done = write_body_files(canvas);
    } else {
        done = write_plane_files(canvas);
    }
    return result ? done : result;
}

/// How many frames are drawn at a time. The limit of memory counts one picture.
int RunResults::drawing_threads() const {
    const SimulationOptions& options = request.simulation;
    if (options.memory_limit > 0) return 1;
    return options.threads > 0 ? options.threads : hardware_threads();
}

Result<void> RunResults::write_frames() {
    if (auto failed = frames->failure()) return tl::unexpected(*failed);
    auto written =
        frames->write(request.frames, painter, texts(request.picture), drawing_threads());
    if (!written) return tl::unexpected(written.error());
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

Result<void> RunResults::write(const Canvas& canvas, const Result<void>& saved) {
    const TimeAccount::Scope spent(request.simulation.account, Spent::drawing);
    // The run may have taken hours, so every output is written even if another one fails.
    std::optional<Failure> first;
    const auto attempt = [&](const Result<void>& done) {
        if (!done && !first) first = done.error();
    };
    attempt(write_outputs(canvas));
    if (log) attempt(write_log());
    if (!request.frames.empty()) attempt(write_frames());
    if (!request.sheet.empty()) {
        attempt(write_picture(request.sheet, draw_sheet(simulation, request.picture)));
    }
    if (!request.volume.empty()) attempt(write_volume());
    if (series) attempt(write_series());
    attempt(saved);
    if (!request.save.empty() && saved) report.written.push_back(request.save);
    if (painter.fell_back() && control.warn) {
        control.warn(
            "where the picture names a stage that has not run, the default picture is "
            "drawn instead");
    }
    if (!first) return {};
    if (!report.written.empty()) {
        first->hint += fmt::format("{}written all the same: {}", first->hint.empty() ? "" : "; ",
                                   report.written.back().string());
    }
    return tl::unexpected(*first);
}

}  // namespace cascade
