// Options that do not fit are reported at the option's text; files and folders are tested for
// writing.
#include "run/commands/run_checks.h"

#include "core/file.h"
#include "core/file_format.h"
#include "core/temporary_file.h"
#include "export/levels.h"
#include "export/material_maps.h"
#include "film/film.h"
#include "lang/check/check.h"
#include "picture/caption.h"
#include "picture/vdb.h"
#include "run/commands/model_checks.h"
#include "run/pictures/body_picture.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/frame_folder.h"
#include "run/pictures/material.h"
#include "run/pictures/model_maps.h"
#include "run/pictures/picture_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace cascade {

std::vector<std::filesystem::path> outputs_of(const Script& script, const RunRequest& request) {
    if (!request.outputs.empty()) return request.outputs;
    const std::filesystem::path picture = output_stem(script) + ".png";
    // Running a picture again may overwrite it.
    std::error_code error;
    if (std::filesystem::equivalent(picture, script.file, error))
        return {output_stem(script) + "-again.png"};
    return {picture};
}

std::filesystem::path log_path(const RunRequest& request,
                               const std::filesystem::path& first_output) {
    if (!request.log.file.empty()) return request.log.file;
    return std::filesystem::path(first_output).replace_extension(".csv");
}

std::vector<std::filesystem::path> turntable_paths(const std::filesystem::path& picture,
                                                   int count) {
    const std::size_t digits = std::max<std::size_t>(3, fmt::formatted_size("{}", count));
    std::vector<std::filesystem::path> paths;
    for (int k = 1; k <= count; ++k) {
        std::filesystem::path path = picture;
        std::filesystem::path name = picture.stem();
        name += fmt::format("-{:0{}}", k, digits);
        name += picture.extension();
        paths.push_back(path.replace_filename(name));
    }
    return paths;
}

namespace {

/// A file that a run writes, and the name of the output in messages.
struct OutputFile {
    std::filesystem::path path;
    std::string_view what;
};

std::string_view name_of(FormatKind kind) {
    if (kind == FormatKind::picture) return "the picture";
    if (kind == FormatKind::figure) return "the figure";
    return kind == FormatKind::film ? "the film" : "the model";
}

std::vector<OutputFile> files_of(const Script& script, const RunRequest& request,
                                 std::span<const std::filesystem::path> outputs) {
    const MapSet maps = has_cells(script) ? MapSet{.heights = true, .normals = true}
                                          : maps_said(script, request.picture.bump != 0);
    const auto levels = static_cast<std::size_t>(request.model_files.levels);
    std::vector<OutputFile> files;
    const auto add = [&](std::span<const std::filesystem::path> paths, std::string_view what) {
        for (const auto& path : paths) files.push_back({path, what});
    };
    for (const auto& output : outputs) {
        const FormatKind kind = output_kind(output).value_or(FormatKind::picture);
        if (kind == FormatKind::picture && request.turntable > 0) {
            add(turntable_paths(output, request.turntable), "the picture");
        } else if (request.model_files.is_baked(output)) {
            for (std::size_t k = 0; k < levels; ++k) {
                add(map_paths_of_level(output, k, maps, request.picture.displace,
                                       request.model_files.map_format),
                    "the baked model");
            }
        } else if (kind == FormatKind::model) {
            for (std::size_t k = 0; k < levels; ++k) {
                const std::filesystem::path path = path_of_level(output, k);
                add({&path, 1}, name_of(kind));
            }
        } else {
            add({&output, 1}, name_of(kind));
        }
    }
    if (!request.sheet.empty()) files.push_back({request.sheet, "--sheet"});
    if (!request.log.expressions.empty()) {
        files.push_back({log_path(request, outputs[0]), "the log"});
    }
    if (!request.volume.empty()) files.push_back({request.volume, "--volume"});
    if (!request.series.empty()) files.push_back({request.series, "--series"});
    return files;
}

}  // namespace

Result<void> check_outputs(const Script& script, const RunRequest& request,
                           std::span<const std::filesystem::path> outputs) {
    std::vector<OutputFile> files = files_of(script, request, outputs);
    std::set<std::filesystem::path> folders;
    for (const OutputFile& file : files) {
        if (auto good = check_writable(file.path); !good) return good;
        if (is_film(file.path)) {
            if (auto good = check_film(file.path); !good) return good;
        }
        if (is_of_format(file.path, FileFormat::vdb)) {
            if (auto good = check_vdb(file.path); !good) return good;
        }
        folders.insert(file.path.parent_path());
    }
    for (const auto& folder : folders) remove_dead_temporaries(folder);
    std::stable_sort(files.begin(), files.end(), [](const OutputFile& a, const OutputFile& b) {
        return a.path.lexically_normal() < b.path.lexically_normal();
    });
    const auto twice =
        std::adjacent_find(files.begin(), files.end(),
                           [](const OutputFile& a, const OutputFile& b) {
                               return a.path.lexically_normal() == b.path.lexically_normal();
                           });
    if (twice == files.end()) return {};
    return failure(fmt::format("{} and {} are both to be written to {}", twice[0].what,
                               twice[1].what, twice->path.string()));
}

Result<void> check_film_sizes(const Script& script, const RunRequest& request,
                              const std::atomic<bool>& cancel) {
    const PictureSize size = picture_size(script, request.picture);
    for (const auto& output : request.outputs) {
        if (!is_film(output)) continue;
        if (auto good = check_film_size(output, size.width, size.height, cancel); !good) {
            return good;
        }
    }
    if (request.labels.empty() || has_room_for_caption(size.width, size.height)) return {};
    return failure(fmt::format("frames of {} × {} pixels have no room for a label", size.width,
                               size.height),
                   "a larger --scale or --size makes room");
}

Result<void> check_folders(const RunRequest& request, Folders folders) {
    for (const auto& folder : {request.frames, request.save}) {
        if (folder.empty()) continue;
        std::error_code error;
        std::vector<std::filesystem::path> missing;
        for (auto above = std::filesystem::absolute(folder, error);
             above.has_relative_path() && !std::filesystem::exists(above, error);
             above = above.parent_path()) {
            missing.push_back(above);
        }
        Result<void> good = make_folder(folder);
        if (good) good = check_writable(folder / "run.json");
        if (good) remove_dead_temporaries(folder);
        if (folders == Folders::tried) {
            for (const auto& made : missing) std::filesystem::remove(made, error);
        }
        if (!good) return good;
    }
    return {};
}

namespace {

/// Reports a `--stop-at` that the run never reaches.
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
    script.diagnostics.error(span,
                             fmt::format("stage '{}' has {} steps", stop_at.stage, iterations));
}

/// Outputs with rows and columns, which a model does not have.
void check_on_model(OptionRefuser& options, const RunRequest& request) {
    const std::string message = "the cells of a model have no rows and columns";
    options.refuse_if(request.picture.flat, "--flat", message,
                      "-o model.ply has the pattern without light");
    options.refuse_if(request.picture.space_time, "--space-time", message,
                      "--frames writes a picture each interval");
    options.refuse_if(!request.sheet.empty(), "--sheet", message, "--show a draws another species");
    options.refuse_if(!request.volume.empty(), "--volume", message,
                      "-o model.vtp has all species for ParaView");
    options.refuse_if(request.features, "--features", message, "");
}

/// `has_body` says that --flat shows a slice in place of a body.
void check_on_plane(OptionRefuser& options, const RunRequest& request, bool has_body) {
    const std::string message = "the domain is not a surface";
    const std::string hint = "surface: x, y, z in the domain makes one";
    if (!has_body) options.refuse_if(request.picture.flat, "--flat", message, hint);
    options.refuse_if(request.picture.is_turned(), "--view", message, hint);
    options.refuse_if(request.picture.fov.has_value(), "--fov", message, hint);
    options.refuse_if(!request.picture.ground, "--ground", message, hint);
    options.refuse_if(request.picture.background != pure_white, "--background", message, hint);
    options.refuse_if(request.picture.quality != Quality::normal, "--quality", message, hint);
    options.refuse_if(request.picture.lighting != Lighting::sun, "--light", message, hint);
    options.refuse_if(request.turntable > 0 || request.picture.view.is_turning, "--turntable",
                      message, hint);
}

/// Smooth pictures, and copies side by side.
void check_flat_picture(OptionRefuser& options, const Script& script,
                        const PictureRequest& picture) {
    const bool has_copies = picture.copies != PictureCopies();
    if (draws_scene(script, picture)) {
        options.refuse_if(has_copies, "--copies", "only planes are drawn in copies",
                          "of a surface by a formula, --flat draws the texture alone");
        return;
    }
    options.refuse_if(picture.size && picture.space_time, "--size",
                      "a space-time picture has a pixel for each cell and interval",
                      "--scale N draws them as N x N pixels");
    options.refuse_if(has_copies && picture.space_time, "--copies",
                      "a space-time picture has no copies", "");
    const auto [columns, rows] = sides_that_repeat(script.program->domain.grid, picture.slice);
    const std::string hint = "a domain with boundary: periodic repeats";
    options.refuse_if(picture.copies.across > 1 && !columns, "--copies",
                      "the pattern does not go on at its left and right sides", hint);
    options.refuse_if(picture.copies.down > 1 && !rows, "--copies",
                      "the pattern does not go on at its upper and lower sides", hint);
}

/// Outputs of rows and columns, which cells that crawl do not lie in.
void check_with_cells(OptionRefuser& options, const RunRequest& request) {
    const std::string message = "cells that crawl have no rows and columns";
    options.refuse_if(request.picture.space_time, "--space-time", message,
                      "--frames writes a picture each interval");
    options.refuse_if(request.picture.flat, "--flat", message, "");
    options.refuse_if(request.picture.bump != 0, "--bump", message, "a shape has a height");
    options.refuse_if(!request.sheet.empty(), "--sheet", message, "--show e draws another value");
    for (const auto& [option, file] :
         {std::pair("--volume", request.volume), std::pair("--series", request.series)}) {
        options.refuse_if(!file.empty(), option, message,
                          "-o NAME.cells.vtp has all values at the end, for ParaView");
    }
    options.refuse_if(request.features, "--features", message, "");
    options.refuse_if(request.model_files.retile, "--retile", message, "");
}

/// Options for films without a film, and films that cannot be.
void check_films(OptionRefuser& options, const RunRequest& request) {
    const auto film = std::find_if(request.outputs.begin(), request.outputs.end(), is_film);
    const bool has_film = film != request.outputs.end();
    const FilmRequest& wanted = request.film;
    const std::string message = "no film is written";
    const std::string hint = output_of(FormatKind::film) + " writes one";
    const bool has_pace = has_film || request.model_files.animate;
    options.refuse_if(wanted.frames_per_second > 0 && !has_pace, "--fps", message, hint);
    options.refuse_if(wanted.seconds > 0 && !has_pace, "--seconds", message, hint);
    options.refuse_if(request.slices > 0 && !has_film, "--slices", message, hint);
    options.refuse_if(!request.labels.empty() && request.frames.empty() && !films_steps(request),
                      "--label", "no frames of a run are drawn",
                      "--frames FOLDER and -o NAME.gif draw them");
    if (!has_film) return;
    options.refuse_if(request.picture.space_time, "--space-time",
                      "a space-time picture is one picture, and no film", "-o NAME.png draws it");
    for (const auto& output : request.outputs) {
        if (!is_film(output)) continue;
        if (auto good = check_pace(output, wanted.frames_per_second); !good) {
            options.refuse("--fps", "--fps", good.error().message, good.error().hint);
        }
        options.refuse_if(
            !request.picture.background && !can_hold(output, FormatTrait::transparency),
            "--background",
            fmt::format("an {} film has no transparent pixels", find_format(output)->name),
            output_of(FormatTrait::transparency) + " has them, or give a colour");
    }
    if (request.session && films_steps(request)) {
        options.refuse("-o", film->string(),
                       "a session is played to its end before anything is written",
                       "of a surface, --turntable N films its end from all around");
    }
}

/// The end of the run is carried to finer cells, and nothing but the end.
void check_detail(OptionRefuser& options, const Script& script, const RunRequest& request) {
    if (request.picture.detail == 1) return;
    const std::string option = "--detail";
    const auto& model = script.program->domain.model;
    const auto& mask = script.program->domain.mask;
    options.refuse_if(has_cells(script), option, "cells that crawl have no finer cells",
                      "--size draws them larger");
    options.refuse_if(model && model->cells != ModelCellKind::spread, option,
                      "cells that are faces or points of a model cannot be divided",
                      "--cells 20000 spreads cells, which can");
    options.refuse_if(mask && std::any_of(mask->formula.nodes.begin(), mask->formula.nodes.end(),
                                          is_draw_in_cell),
                      option, "the mask draws a random number in each cell",
                      "noise(…) has the same outlines in finer cells");
    options.refuse_if(request.session.has_value(), option, "a session ends with its own cells",
                      "-o tile.glb --bake 2048 writes smooth maps of a plane");
    const std::string message = "it shows every step, and only the end is carried to finer cells";
    const std::string hint = "a script with a finer grid shows all steps on it";
    options.refuse_if(!request.frames.empty(), "--frames", message, hint);
    options.refuse_if(!request.series.empty(), "--series", message, hint);
    options.refuse_if(request.model_files.animate, "--animate", message, hint);
    options.refuse_if(request.picture.space_time, "--space-time", message, hint);
    const auto film = std::find_if(request.outputs.begin(), request.outputs.end(), is_film);
    if (film != request.outputs.end() && films_steps(request))
        options.refuse("-o", film->string(), message, hint);
}

void check_panels(OptionRefuser& options, const RunRequest& request) {
    constexpr std::size_t most = 26;  // They have letters.
    const bool has_figure =
        std::any_of(request.outputs.begin(), request.outputs.end(),
                    [](const auto& output) { return output_kind(output) == FormatKind::figure; });
    options.refuse_if(!request.panels.empty() && !has_figure, "--panel", "no figure is drawn",
                      output_of(FormatKind::figure) + " draws one");
    options.refuse_if(request.panels.size() > most, "--panel",
                      fmt::format("a figure has at most {} panels", most), "");
}

/// What is written while a run takes its steps.
void check_with_session(OptionRefuser& options, const RunRequest& request) {
    const std::string message = "a session is played to its end before anything is written";
    const std::string hint = "'cascade repl' plays it, and goes on from there";
    options.refuse_if(!request.frames.empty(), "--frames", message, hint);
    options.refuse_if(!request.series.empty(), "--series", message, hint);
    options.refuse_if(request.picture.space_time, "--space-time", message, hint);
    options.refuse_if(!request.log.expressions.empty(), "--log", message, hint);
    options.refuse_if(request.stop_at.has_value(), "--stop-at", message, hint);
    options.refuse_if(request.checkpoint_seconds > 0, "--checkpoint", message, hint);
}

}  // namespace

Result<void> check_request(Script& script, const RunRequest& request) {
    const DomainSettings& domain = script.program->domain;
    OptionRefuser options(script);
    const std::int64_t rows = domain.grid.height * domain.grid.depth;
    if (request.picture.space_time && rows != 1 && !domain.model) {
        options.refuse("--space-time", "--space-time",
                       fmt::format("a space-time picture is drawn of a grid of one row, not of {}",
                                   rows),
                       "for a plane, --frames writes a picture each interval");
    }
    std::error_code error;
    options.refuse_if(is_called_like_a_movie(request.frames) &&
                          !std::filesystem::is_directory(request.frames, error),
                      "--frames", "frames are pictures in a folder, and this is named like a film",
                      is_film(request.frames)
                          ? fmt::format("-o {} writes a film", request.frames.string())
                          : "-o NAME.mp4 writes a film");
    for (const auto& [option, is_given] : {std::pair("--slice", request.picture.slice != Slice{}),
                                           std::pair("--slices", request.slices > 0)}) {
        options.refuse_if(is_given && domain.grid.depth == 1, option, "a plane has no slices",
                          "grid: W, H, D makes a volume");
    }
    options.refuse_if(
        !request.volume.empty() && !can_hold(request.volume, FormatTrait::planes) &&
            domain.grid.depth == 1 && !domain.model,
        "--volume",
        fmt::format("a {} file holds a volume, and this is a plane", lower_ending(request.volume)),
        fmt::format("--volume NAME{} writes planes, too; grid: W, H, D makes a volume",
                    endings_of(FormatTrait::planes, "or")));
    if (has_cells(script)) {
        check_with_cells(options, request);
        if (domain.model) check_model_files(options, request);
        else check_without_surface(options, request);
        check_levels_of_cells(options, request);
    } else if (domain.model) {
        check_on_model(options, request);
        check_model_files(options, request);
        check_heights(options, request, maps_said(script, request.picture.bump != 0).heights);
    } else if (draws_body(script, request.picture)) {
        check_of_body(options, request);
    } else {
        check_without_model(options, request, !domain.surface);
        const bool has_body = picture_expression(script.tree, "body").has_value();
        if (!domain.surface) check_on_plane(options, request, has_body);
    }
    check_flat_picture(options, script, request.picture);
    check_films(options, request);
    check_detail(options, script, request);
    check_panels(options, request);
    if (request.session) check_with_session(options, request);
    if (request.stop_at) check_stop_at(script, *request.stop_at);
    if (script.diagnostics.has_errors()) return failure("the request does not fit the script");
    return {};
}

}  // namespace cascade
