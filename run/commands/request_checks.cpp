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
    "--mesh FILE, or mesh: \"FILE\" in the domain, makes it one";
constexpr const char* shows_every_interval = "--frames writes a picture each interval";

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
    /// Refuses all of `options` that are given.
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

    template <typename Is>
    bool has_output(const Is& is) const {
        return std::any_of(request_.outputs.begin(), request_.outputs.end(), is);
    }
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
                   fmt::format("a space-time picture is drawn of a grid of one row, not of {}",
                               rows),
                   fmt::format("for a plane, {}", shows_every_interval));
        }
        std::error_code error;
        refuse_if(is_called_like_a_movie(request_.frames) &&
                      !std::filesystem::is_directory(request_.frames, error),
                  frames, "frames are pictures in a folder, and this is named like a film",
                  is_film(request_.frames)
                      ? fmt::format("-o {} writes a film", request_.frames.string())
                      : "-o NAME.mp4 writes a film");
        const bool is_csv = is_of_format(request_.series, FileFormat::csv);
        refuse_if(is_csv && (rows != 1 || domain_.model), series,
                  "a .csv series has a row of cells",
                  "--series NAME.npy has planes, volumes and models, too");
        if (request_.series.empty() || is_of_format(request_.series, FileFormat::pvd)) {
            refuse({field}, "no array of fields is written",
                   "--series NAME.npy writes one, NAME.h5 a dataset for each, and NAME.csv a table "
                   "of a line of cells");
        }
        if (!is_volume)
            refuse({slice, slices}, "a plane has no slices", "grid: W, H, D makes a volume");
        if (!is_volume && !domain_.model && !can_hold(request_.volume, FormatTrait::planes)) {
            refuse({volume},
                   fmt::format("a {} file holds a volume, and this is a plane",
                               lower_ending(request_.volume)),
                   fmt::format("--volume NAME{} writes planes, too; grid: W, H, D makes a volume",
                               endings_of(FormatTrait::planes, "or")));
        }
    }

    /// Refuses outputs that need rows and columns, because the cells of a model have none.
    void check_on_model() {
        const std::string message = "the cells of a model have no rows and columns";
        refuse({flat}, message, "-o model.ply has the pattern without light");
        refuse({space_time}, message, shows_every_interval);
        refuse({sheet}, message, "--show a draws another species");
        refuse({volume}, message, "-o model.vtp has all species for ParaView");
        refuse({features}, message);
        check_model_files();
        if (maps_said(script_, request_.picture.bump != 0).heights) return;
        refuse({displace}, "the surface has no heights",
               "height: e in the picture block gives them, or --bump");
    }

    void check_on_plane() {
        const std::string message = "the domain is not a surface";
        const std::string hint = "surface: x, y, z in the domain makes one";
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
        refuse({bump}, message, "a shape has a height");
        refuse({sheet}, message, "--show e draws another value");
        refuse({volume, series}, message,
               "-o NAME.cells.vtp has all values at the end, for ParaView");
        if (domain_.model) check_model_files();
        else check_without_surface();
        const std::string copies_of_shapes = "cells that crawl are written as copies of shapes";
        for (const auto& output : request_.outputs) {
            if (!is_of_kind(output, FormatKind::model)) continue;
            if (can_hold(output, FormatTrait::copies)) continue;
            refuse_output(output, copies_of_shapes,
                          output_of(FormatTrait::copies) + " writes them");
        }
        refuse({lods}, copies_of_shapes,
               "'detail' in the picture block says how fine the shapes are");
        refuse({displace}, copies_of_shapes, "--bake writes their heights as a map");
        refuse({animate}, copies_of_shapes, "-o NAME.gif and other films show how they move");
        refuse({texels_per_cell}, "cells that crawl have sizes of their own",
               "--bake N says how many texels");
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
        refuse({lods}, "no model is written", how_to_write(FormatKind::model));
    }

    /// Checks the options for models that show how the pattern grew.
    void check_animated() {
        if (!files_.animate) return;
        refuse_if(!has_output([&](const auto& output) { return files_.is_animated(output); }),
                  animate, "no model is written that could move",
                  how_to_write(FormatTrait::growth));
        refuse_if(files_.has_maps(), animate, "maps do not move",
                  fmt::format("leave out {}: colours of points do",
                              flag_of(is_given(request_, bake) ? bake : texels_per_cell)));
        refuse_if(files_.levels > 1, animate, "levels of detail do not move", "leave out --lods");
        refuse_if(files_.retile, animate, "the triangles of --retile do not move",
                  "leave out --retile");
        refuse_if(writes_one_moment(request_), animate,
                  "a session is played to its end before anything is written",
                  "a run of its script shows how it grows");
    }

    /// On a model: refuses options that apply to files which are not requested.
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
            refuse({retile}, "no model is written that it could tile",
                   how_to_write(FormatKind::model));
        }
        check_levels();
        if (!has_output(is_baked)) {
            refuse({bake, texels_per_cell}, "no model is written with its maps",
                   how_to_write(FormatTrait::maps));
            refuse({exr}, "no maps are written", how_to_write_maps());
        }
        if (!has_texture) {
            refuse({unwrap},
                   files_.retile && is_tiled
                       ? "the triangles of --retile have no texture coordinates"
                       : "no model is written that has texture coordinates",
                   how_to_write(FormatTrait::texture));
        }
        check_animated();
        if (has_picture) return;
        refuse({turntable}, "no picture is drawn",
               "-o NAME.png draws pictures NAME-001.png, …, and -o NAME.gif a film");
    }

    /// Checks the outputs of a body. A body has a surface, but the surface has no cells.
    void check_of_body() {
        for (const auto& output : request_.outputs) {
            if (!is_of_kind(output, FormatKind::cells)) continue;
            refuse_output(output, "only models are written to such files",
                          "--volume FILE.vti has all species of a volume");
        }
        check_without_surface();
        check_cells_of_model();
        check_levels();
    }

    /// On a grid: refuses options that need a model. Planes have maps, too, if `is_plane`.
    void check_without_model(bool is_plane) {
        bool has_model = false;
        for (const auto& output : request_.outputs) {
            const bool is_cells = is_of_kind(output, FormatKind::cells);
            if (!is_cells && !is_of_kind(output, FormatKind::model)) continue;
            has_model = true;
            const bool has_maps = is_plane && can_hold(output, FormatTrait::maps);
            if (has_maps && files_.has_maps()) continue;
            refuse_output(output,
                          fmt::format("only models are written to such files, and {}", not_a_model),
                          has_maps ? "--bake N writes a rectangle with maps of N texels"
                                   : how_to_get_a_model);
        }
        check_cells_of_model();
        refuse({lods}, not_a_model, how_to_get_a_model);
        if (!is_plane) return check_without_surface();
        refuse({unwrap}, not_a_model, how_to_get_a_model);
        if (!files_.has_maps()) refuse({exr}, "no maps are written", how_to_write_maps());
        if (!has_model) {
            refuse({bake, texels_per_cell}, "no model is written with its maps",
                   output_of(FormatTrait::maps) + " writes a rectangle with them");
        }
    }

    /// Refuses sizes and numbers of copies that are impossible for a flat picture.
    void check_flat_picture() {
        const PictureRequest& picture = request_.picture;
        if (draws_scene(script_, picture)) {
            refuse({copies}, "only planes are drawn in copies",
                   "of a surface by a formula, --flat draws the texture alone");
            return;
        }
        if (picture.space_time) {
            refuse({size}, "a space-time picture has a pixel for each cell and interval",
                   "--scale N draws them as N x N pixels");
            refuse({copies}, "a space-time picture has no copies");
        }
        const auto [columns, rows] = sides_that_repeat(domain_.grid, picture.slice);
        const std::string hint = "a domain with boundary: periodic repeats";
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
            refuse({label}, "no frames of a run are drawn",
                   "--frames FOLDER and -o NAME.gif draw them");
        }
        if (!has_film) return;
        refuse({space_time}, "a space-time picture is one picture, and no film",
               "-o NAME.png draws it");
        for (const auto& output : request_.outputs) {
            if (is_film(output)) check_film_format(output);
        }
        if (writes_one_moment(request_) && films_steps(request_)) {
            refuse_output(first_film(), "a session is played to its end before anything is written",
                          "of a surface, --turntable N films its end from all around");
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

    /// Checks --detail. It carries only the end of a run, so other outputs are refused.
    void check_detail() {
        if (request_.picture.detail == 1) return;
        const auto& model = domain_.model;
        const auto& mask = domain_.mask;
        refuse_if(has_cells(script_), detail, "cells that crawl have no finer cells",
                  "--size draws them larger");
        refuse_if(model && model->cells != ModelCellKind::spread, detail,
                  "cells that are faces or points of a model cannot be divided",
                  "--cells 20000 spreads cells, which can");
        refuse_if(mask && std::any_of(mask->formula.nodes.begin(), mask->formula.nodes.end(),
                                      is_draw_in_cell),
                  detail, "the mask draws a random number in each cell",
                  "noise(…) has the same outlines in finer cells");
        refuse_if(writes_one_moment(request_), detail, "a session ends with its own cells",
                  "-o tile.glb --bake 2048 writes smooth maps of a plane");
        const std::string message =
            "it shows every step, and only the end is carried to finer cells";
        const std::string hint = "a script with a finer grid shows all steps on it";
        refuse({frames, series, animate, space_time}, message, hint);
        if (films_steps(request_)) refuse_output(first_film(), message, hint);
    }

    void check_panels() {
        constexpr std::size_t most = 26;  // Panels are labelled with the letters of the alphabet.
        if (!has_output_of(FormatKind::figure)) {
            refuse({panel}, "no figure is drawn", output_of(FormatKind::figure) + " draws one");
        }
        refuse_if(request_.panels.size() > most, panel,
                  fmt::format("a figure has at most {} panels", most));
    }

    /// For a repeated session: refuses outputs that are written while a run takes its steps.
    void check_with_session() {
        refuse({frames, series, space_time, log, at, every, stop_at, checkpoint},
               "a session is played to its end before anything is written",
               "'cascade repl' plays it and continues from there");
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
