// Checks before the first step whether options and outputs suit the script and can be combined.
#include "core/file_format.h"
#include "film/film.h"
#include "lang/check/check.h"
#include "lang/syntax/picture_expression.h"
#include "run/commands/run_checks.h"
#include "run/commands/run_option.h"
#include "run/pictures/frame_folder.h"
#include "run/pictures/material.h"
#include "run/pictures/picture_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

namespace cascade {

namespace {

constexpr const char* not_a_model = "the domain is not a model";
constexpr const char* how_to_get_a_model =
    "write mesh: \"FILE\" in the domain, or run with --mesh FILE";
constexpr const char* no_model_with_maps =
    "this option writes maps of a model, but no such model is written";
constexpr const char* shows_every_interval = "--frames FOLDER writes a picture at each interval";

template <typename Which>
std::string how_to_write(Which which) {
    return output_of(which) + " writes one";
}
std::string how_to_write_maps() {
    return output_of(FormatTrait::maps) + " --bake 2048 writes them";
}

class RequestChecker {
    using enum RunOption;

public:
    RequestChecker(Script& script, const RunRequest& request)
        : script_(script),
          request_(request),
          files_(request.model_files),
          domain_(script.program->domain) {}

    void check() {
        check_of_domain();
        if (has_cells(script_)) {
            check_with_cells();
        } else if (domain_.model) {
            check_on_model();
        } else if (draws_body(script_, request_.picture)) {
            check_of_body();
        } else {
            check_without_model(!domain_.surface);
            if (!domain_.surface) check_on_plane();
        }
        check_flat_picture();
        check_films();
        check_detail();
        check_panels();
        if (writes_one_moment(request_)) check_with_session();
        if (request_.stop_at) check_stop_at(script_, *request_.stop_at);
    }

private:
    using Options = std::initializer_list<RunOption>;

    void report(const std::string& option, const std::string& text, const std::string& message,
                const std::string& hint) {
        script_.diagnostics.error(option_span(script_.sources, option, text), message, hint);
    }
    /// If any of `options` is given, adds an error for it.
    void refuse(Options options, const std::string& message, const std::string& hint = "") {
        for (const RunOption each : options) {
            refuse_if(is_given(request_, each), each, message, hint);
        }
    }
    void refuse_if(bool is_wrong, RunOption option, const std::string& message,
                   const std::string& hint = "") {
        if (is_wrong) report(flag_of(option), flag_of(option), message, hint);
    }
    void refuse_output(const std::filesystem::path& output, const std::string& message,
                       const std::string& hint) {
        report("-o", output.string(), message, hint);
    }

    bool has_output(const auto& is) const { return std::ranges::any_of(request_.outputs, is); }
    bool has_output_of(FormatKind kind) const {
        return has_output([=](const auto& output) { return is_of_kind(output, kind); });
    }
    const std::filesystem::path& first_film() const {
        return *std::find_if(request_.outputs.begin(), request_.outputs.end(), is_film);
    }

    /// Refuses options that are impossible for the kind of the script's domain.
    void check_of_domain() {
        const bool is_volume = domain_.grid.depth > 1;
        const std::int64_t rows = domain_.grid.height * domain_.grid.depth;
        if (rows != 1 && !domain_.model) {
            refuse({space_time},
                   fmt::format("a space-time picture needs a grid of one row, not of {}", rows),
                   fmt::format("for a plane, {}", shows_every_interval));
        }
        std::error_code error;
        refuse_if(is_called_like_a_movie(request_.frames) &&
                      !std::filesystem::is_directory(request_.frames, error),
                  frames, "--frames writes pictures into a folder, but this is the name of a film",
                  is_film(request_.frames)
                      ? fmt::format("-o {} writes a film", request_.frames.string())
                      : "-o NAME.mp4 writes a film");
        const bool is_csv = is_of_format(request_.series, FileFormat::csv);
        refuse_if(is_csv && (rows != 1 || domain_.model), series,
                  "a .csv series can hold only one row of cells",
                  "use --series NAME.npy for planes, volumes and models");
        if (request_.series.empty() || is_of_format(request_.series, FileFormat::pvd)) {
            refuse({field}, "--field needs a series in an .npy, .h5 or .csv file",
                   "add --series NAME.npy or NAME.h5, or for a line of cells NAME.csv");
        }
        if (!is_volume)
            refuse({slice, slices}, "this domain is a plane, which has no slices",
                   "write grid: W, H, D for a volume");
        if (!is_volume && !domain_.model && !can_hold(request_.volume, FormatTrait::planes)) {
            refuse({volume},
                   fmt::format("a {} file can hold only a volume, but this grid is a plane",
                               lower_ending(request_.volume)),
                   fmt::format("use --volume NAME{} for a plane; write grid: W, H, D for a volume",
                               endings_of(FormatTrait::planes, "or")));
        }
    }

    /// Refuses outputs that need rows and columns, because the cells of a model have none.
    void check_on_model() {
        const std::string message = "the cells of a model have no rows and columns";
        refuse({flat}, message, "use -o model.ply for the pattern without light");
        refuse({space_time}, message, shows_every_interval);
        refuse({sheet}, message, "use --show a to draw another species");
        refuse({volume}, message, "use -o model.vtp for all species in ParaView");
        refuse({features}, message);
        check_model_files();
        if (maps_said(script_, request_.picture.bump != 0).heights) return;
        refuse({displace}, "the surface has no heights",
               "write height: e in the picture block, or use --bump");
    }

    void check_on_plane() {
        const std::string message = "the domain is not a surface";
        const std::string hint = "write surface: x, y, z in the domain for a surface";
        const bool shows_slice = picture_expression(script_.tree, "body").has_value();
        refuse_if(request_.picture.flat && !shows_slice, flat, message, hint);
        refuse({view, fov, ground, background, quality, lighting}, message, hint);
        refuse_if(request_.turntable > 0 || request_.picture.view.is_turning, turntable, message,
                  hint);
    }

    /// Refuses outputs that need rows and columns, because crawling cells have none.
    void check_with_cells() {
        const std::string message = "cells that crawl have no rows and columns";
        refuse({space_time}, message, shows_every_interval);
        refuse({flat, features, retile}, message);
        refuse({bump}, message, "write height: e in the picture block for the height of shapes");
        refuse({sheet}, message, "use --show e to draw another value");
        refuse({volume, series}, message,
               "use -o NAME.cells.vtp for all values at the end, in ParaView");
        if (domain_.model) check_model_files();
        else check_without_surface();
        const std::string copies_of_shapes = "cells that crawl are written as copies of shapes";
        for (const auto& output : request_.outputs) {
            if (!is_of_kind(output, FormatKind::model)) continue;
            if (can_hold(output, FormatTrait::copies)) continue;
            refuse_output(output, copies_of_shapes,
                          output_of(FormatTrait::copies) + " writes them");
        }
        refuse({lods}, copies_of_shapes, "write detail: 0.2 in the picture block for finer shapes");
        refuse({displace}, copies_of_shapes, "use --bake to write the heights as a map");
        refuse({animate}, copies_of_shapes, "use -o NAME.gif for a film of the moving cells");
        refuse({texels_per_cell},
               "cells that crawl differ in size, so their size in texels cannot be set",
               "use --bake N for maps of N x N texels");
    }

    /// Refuses options that need a model, if there are bodies or crawling cells without a model.
    void check_without_surface() {
        refuse({bake, texels_per_cell, exr, unwrap}, not_a_model, how_to_get_a_model);
    }

    /// Refuses options that need the cells of a model.
    void check_cells_of_model() {
        refuse({retile, displace, animate, bump, cache}, not_a_model, how_to_get_a_model);
    }

    void check_levels() {
        if (has_output_of(FormatKind::model)) return;
        refuse({lods}, "--lods needs a model, but no model is written",
               how_to_write(FormatKind::model));
    }

    /// Checks --animate, which shows in a model how the pattern grew.
    void check_animated() {
        if (!files_.animate) return;
        refuse_if(!has_output([&](const auto& output) { return files_.is_animated(output); }),
                  animate, "--animate needs a model that can be animated, but none is written",
                  how_to_write(FormatTrait::growth));
        refuse_if(files_.has_maps(), animate, "a model with maps cannot be animated",
                  fmt::format("leave out {}: colours of points can be animated",
                              flag_of(is_given(request_, bake) ? bake : texels_per_cell)));
        refuse_if(files_.levels > 1, animate, "levels of detail cannot be animated",
                  "leave out --lods");
        refuse_if(files_.retile, animate, "the triangles of --retile cannot be animated",
                  "leave out --retile");
        refuse_if(writes_one_moment(request_), animate, "only the end of a session can be written",
                  "run the session's script to see how the pattern grows");
    }

    /// On a model: refuses options that apply only to files that are not requested.
    void check_model_files() {
        const auto is_baked = [&](const auto& output) { return files_.is_baked(output); };
        const bool is_tiled = has_output([&](const auto& output) {
            return is_of_kind(output, FormatKind::model) && !is_baked(output);
        });
        const bool has_texture = has_output([&](const auto& output) {
            return is_baked(output) || (!files_.retile && can_hold(output, FormatTrait::texture));
        });
        const bool has_picture =
            request_.outputs.empty() || has_output_of(FormatKind::picture) || has_output(is_film);
        if (!is_tiled) {
            refuse({retile}, "--retile needs a model, but no model is written",
                   how_to_write(FormatKind::model));
        }
        check_levels();
        if (!has_output(is_baked)) {
            refuse({bake, texels_per_cell}, no_model_with_maps, how_to_write(FormatTrait::maps));
            refuse({exr}, "--exr needs maps, but no maps are written", how_to_write_maps());
        }
        if (!has_texture) {
            refuse({unwrap},
                   files_.retile && is_tiled
                       ? "the triangles of --retile have no texture coordinates"
                       : "--unwrap needs a model file with texture coordinates, but none is "
                         "written",
                   how_to_write(FormatTrait::texture));
        }
        check_animated();
        if (has_picture) return;
        refuse({turntable}, "--turntable needs a picture or a film, but none is requested",
               "add -o NAME.png for pictures NAME-001.png, …, or -o NAME.gif for a film");
    }

    /// Checks the outputs of a body. A body has a surface, but the surface has no cells.
    void check_of_body() {
        for (const auto& output : request_.outputs) {
            if (!is_of_kind(output, FormatKind::cells)) continue;
            refuse_output(output, "only models can be written to such files",
                          "use --volume FILE.vti for all species of a volume");
        }
        check_without_surface();
        check_cells_of_model();
        check_levels();
    }

    /// On a grid: refuses options that need a model. Permits maps of a plane if `is_plane` is true.
    void check_without_model(bool is_plane) {
        bool has_model = false;
        for (const auto& output : request_.outputs) {
            const bool is_cells = is_of_kind(output, FormatKind::cells);
            if (!is_cells && !is_of_kind(output, FormatKind::model)) continue;
            has_model = true;
            const bool has_maps = is_plane && can_hold(output, FormatTrait::maps);
            if (has_maps && files_.has_maps()) continue;
            refuse_output(output,
                          fmt::format("only models can be written to such files, but {}",
                                      not_a_model),
                          has_maps ? "add --bake N for a rectangle with maps of N x N texels"
                                   : how_to_get_a_model);
        }
        check_cells_of_model();
        refuse({lods}, not_a_model, how_to_get_a_model);
        if (!is_plane) return check_without_surface();
        refuse({unwrap}, not_a_model, how_to_get_a_model);
        if (!files_.has_maps())
            refuse({exr}, "--exr needs maps, but no maps are written", how_to_write_maps());
        if (!has_model) {
            refuse({bake, texels_per_cell}, no_model_with_maps,
                   output_of(FormatTrait::maps) + " writes a rectangle with them");
        }
    }

    /// Refuses sizes and numbers of copies that are impossible for a flat picture.
    void check_flat_picture() {
        const PictureRequest& picture = request_.picture;
        if (draws_scene(script_, picture)) {
            refuse({copies}, "only planes can be drawn in copies",
                   "on a surface given by formulas, add --flat to draw only the texture");
            return;
        }
        if (picture.space_time) {
            refuse({size},
                   "the size of a space-time picture is fixed: one pixel for each cell "
                   "and interval",
                   "use --scale N to draw each of them as N x N pixels");
            refuse({copies}, "a space-time picture cannot be drawn in copies");
        }
        const auto [columns, rows] = sides_that_repeat(domain_.grid, picture.slice);
        const std::string hint = "write boundary: periodic in the domain";
        refuse_if(picture.copies.across > 1 && !columns, copies,
                  "the pattern does not repeat across its left and right sides", hint);
        refuse_if(picture.copies.down > 1 && !rows, copies,
                  "the pattern does not repeat across its upper and lower sides", hint);
    }

    /// Refuses options for films if no film is requested, and films that cannot be drawn.
    void check_films() {
        const bool has_film = has_output(is_film);
        const std::string message = "no film is written";
        if (!has_film) refuse({slices}, message, how_to_write(FormatKind::film));
        if (!has_film && !files_.animate) {
            refuse({fps, seconds}, message, how_to_write(FormatKind::film));
        }
        if (request_.frames.empty() && !films_steps(request_)) {
            refuse({label}, "--label needs frames or a film, but none is written",
                   "add --frames FOLDER or -o NAME.gif");
        }
        if (!has_film) return;
        refuse({space_time}, "a space-time picture cannot be written as a film", "use -o NAME.png");
        for (const auto& output : request_.outputs) {
            if (is_film(output)) check_film_format(output);
        }
        if (writes_one_moment(request_) && films_steps(request_)) {
            refuse_output(first_film(), "only the end of a session can be written",
                          "on a surface, add --turntable N to film the end from all sides");
        }
    }

    void check_film_format(const std::filesystem::path& film) {
        if (auto good = check_pace(film, request_.film.frames_per_second); !good) {
            refuse({fps}, good.error().message, good.error().hint);
        }
        refuse_if(!request_.picture.background && !can_hold(film, FormatTrait::transparency),
                  background,
                  fmt::format("an {} film has no transparent pixels", find_format(film)->name),
                  output_of(FormatTrait::transparency) + " has them, or give a colour");
    }

    /// Checks --detail. Refuses outputs over time, because only the end of a run is refined.
    void check_detail() {
        if (request_.picture.detail == 1) return;
        const auto& model = domain_.model;
        refuse_if(has_cells(script_), detail, "cells that crawl cannot be divided into finer cells",
                  "use --size for a larger picture");
        refuse_if(model && model->cells != ModelCellKind::spread, detail,
                  "cells that are faces or points of a model cannot be divided",
                  "use --cells 20000 to spread cells that can be divided");
        refuse_if(domain_.mask && std::ranges::any_of(domain_.mask->formula.nodes, is_draw_in_cell),
                  detail,
                  "--detail cannot keep this mask, which draws a random number in each cell",
                  "use noise(…), whose outlines stay the same in finer cells");
        refuse_if(writes_one_moment(request_), detail,
                  "the end of a session cannot be carried to finer cells",
                  "use -o tile.glb --bake 2048 for smooth maps of a plane");
        const std::string message =
            "this output shows the whole run, but --detail computes finer cells only at the end";
        const std::string hint = "use a finer grid in the script instead";
        refuse({frames, series, animate, space_time}, message, hint);
        if (films_steps(request_)) refuse_output(first_film(), message, hint);
    }

    void check_panels() {
        constexpr std::size_t most = 26;  // A panel is labelled with a letter of the alphabet.
        if (!has_output_of(FormatKind::figure)) {
            refuse({panel}, "--panel needs a figure, but no figure is drawn",
                   output_of(FormatKind::figure) + " draws one");
        }
        refuse_if(request_.panels.size() > most, panel,
                  fmt::format("a figure has at most {} panels", most));
    }

    /// For a repeated session: refuses outputs that are written while a run takes its steps.
    void check_with_session() {
        refuse({frames, series, space_time, log, at, every, stop_at, checkpoint},
               "only the end of a session can be written",
               "use 'cascade repl' to play the session and continue it");
    }

    Script& script_;
    const RunRequest& request_;
    const ModelFileOptions& files_;
    const DomainSettings& domain_;
};

}  // namespace

Result<void> check_request(Script& script, const RunRequest& request) {
    RequestChecker(script, request).check();
    check_moments(script, request);
    if (script.diagnostics.has_errors()) return failure("the request does not fit the script");
    return {};
}

}  // namespace cascade
