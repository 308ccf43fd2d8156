// Each refusal names the option, and the hint what would give it a meaning.
#include "run/commands/model_checks.h"

#include "core/file_format.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

constexpr std::string_view not_a_model = "the domain is not a model";
constexpr std::string_view how_to_get_a_model =
    "--mesh FILE, or mesh: \"FILE\" in the domain, makes it one";

/// The option that asks for maps, if one does.
const char* option_of_maps(const RunRequest& request) {
    return request.model_files.texels_per_cell > 0 ? "--texels-per-cell" : "--bake";
}
template <typename Which>
std::string how_to_write(Which which) {
    return output_of(which) + " writes one";
}
std::string how_to_write_maps() {
    return output_of(FormatTrait::maps) + " --bake 2048 writes them";
}

bool writes_exr(const RunRequest& request) {
    return request.model_files.map_format == MapFormat::exr;
}

bool writes_model(const RunRequest& request) {
    return std::any_of(request.outputs.begin(), request.outputs.end(),
                       [](const auto& output) { return output_kind(output) == FormatKind::model; });
}

/// What is done with the cells of a model alone.
void check_cells_of_model(OptionRefuser& options, const RunRequest& request) {
    for (const auto& [option, is_given] :
         {std::pair("--retile", request.model_files.retile),
          std::pair("--displace", request.picture.displace),
          std::pair("--animate", request.model_files.animate),
          std::pair("--bump", request.picture.bump != 0),
          std::pair("--cache", !request.simulation.cell_cache.empty())}) {
        options.refuse_if(is_given, option, std::string(not_a_model),
                          std::string(how_to_get_a_model));
    }
}

}  // namespace

void check_heights(OptionRefuser& options, const RunRequest& request, bool has_heights) {
    options.refuse_if(request.picture.displace && !has_heights, "--displace",
                      "the surface has no heights",
                      "height: e in the picture block gives them, or --bump");
}

void check_levels_of_cells(OptionRefuser& options, const RunRequest& request) {
    const std::string message = "cells that crawl are written as copies of shapes";
    for (const auto& output : request.outputs) {
        if (!is_of_kind(output, FormatKind::model) || can_hold(output, FormatTrait::copies))
            continue;
        options.refuse("-o", output.string(), message,
                       output_of(FormatTrait::copies) + " writes them");
    }
    options.refuse_if(request.model_files.levels > 1, "--lods", message,
                      "'detail' in the picture block says how fine the shapes are");
    options.refuse_if(request.picture.displace, "--displace", message,
                      "--bake writes their heights as a map");
    options.refuse_if(request.model_files.animate, "--animate", message,
                      "-o NAME.gif and other films show how they move");
    options.refuse_if(request.model_files.texels_per_cell > 0, "--texels-per-cell",
                      "cells that crawl have sizes of their own", "--bake N says how many texels");
}

void check_without_surface(OptionRefuser& options, const RunRequest& request) {
    for (const auto& [option, is_given] :
         {std::pair(option_of_maps(request), request.model_files.has_maps()),
          std::pair("--exr", writes_exr(request)),
          std::pair("--unwrap", request.model_files.unwrap)}) {
        options.refuse_if(is_given, option, std::string(not_a_model),
                          std::string(how_to_get_a_model));
    }
}

/// Models that show how they grew.
void check_animated(OptionRefuser& options, const RunRequest& request) {
    const ModelFileOptions& files = request.model_files;
    if (!files.animate) return;
    const auto& outputs = request.outputs;
    const bool has_glb = std::any_of(outputs.begin(), outputs.end(),
                                     [&](const auto& output) { return files.is_animated(output); });
    options.refuse_if(!has_glb, "--animate", "no model is written that could move",
                      how_to_write(FormatTrait::growth));
    options.refuse_if(files.has_maps(), "--animate", "maps do not move",
                      std::string("leave out ") + option_of_maps(request) +
                          ": colours of points do");
    options.refuse_if(files.levels > 1, "--animate", "levels of detail do not move",
                      "leave out --lods");
    options.refuse_if(files.retile, "--animate", "the triangles of --retile do not move",
                      "leave out --retile");
    options.refuse_if(request.session.has_value(), "--animate",
                      "a session is played to its end before anything is written",
                      "a run of its script shows how it grows");
}

void check_model_files(OptionRefuser& options, const RunRequest& request) {
    const ModelFileOptions& files = request.model_files;
    bool has_picture = request.outputs.empty();
    bool is_baked = false, is_tiled = false, has_texture = false;
    for (const auto& output : request.outputs) {
        has_picture = has_picture || output_kind(output) == FormatKind::picture || is_film(output);
        is_baked = is_baked || files.is_baked(output);
        is_tiled =
            is_tiled || (output_kind(output) == FormatKind::model && !files.is_baked(output));
        has_texture = has_texture || files.is_baked(output) ||
                      (!files.retile && can_hold(output, FormatTrait::texture));
    }
    options.refuse_if(files.retile && !is_tiled, "--retile",
                      "no model is written that it could tile", how_to_write(FormatKind::model));
    options.refuse_if(files.levels > 1 && !writes_model(request), "--lods", "no model is written",
                      how_to_write(FormatKind::model));
    options.refuse_if(files.has_maps() && !is_baked, option_of_maps(request),
                      "no model is written with its maps", how_to_write(FormatTrait::maps));
    options.refuse_if(writes_exr(request) && !is_baked, "--exr", "no maps are written",
                      how_to_write_maps());
    options.refuse_if(files.unwrap && !has_texture, "--unwrap",
                      files.retile && is_tiled
                          ? "the triangles of --retile have no texture coordinates"
                          : "no model is written that has texture coordinates",
                      how_to_write(FormatTrait::texture));
    check_animated(options, request);
    options.refuse_if(request.turntable > 0 && !has_picture, "--turntable", "no picture is drawn",
                      "-o NAME.png draws pictures NAME-001.png, …, and -o NAME.gif a film");
}

void check_of_body(OptionRefuser& options, const RunRequest& request) {
    for (const auto& output : request.outputs) {
        if (output_kind(output) != FormatKind::cells) continue;
        options.refuse("-o", output.string(), "only what grows on a model is written so",
                       "--volume FILE.vti has all species of a volume");
    }
    check_without_surface(options, request);
    check_cells_of_model(options, request);
    options.refuse_if(request.model_files.levels > 1 && !writes_model(request), "--lods",
                      "no model is written", how_to_write(FormatKind::model));
}

void check_without_model(OptionRefuser& options, const RunRequest& request, bool is_plane) {
    const std::string message(not_a_model), hint(how_to_get_a_model);
    bool has_model = false;
    for (const auto& output : request.outputs) {
        const FormatKind kind = output_kind(output).value_or(FormatKind::picture);
        if (kind != FormatKind::model && kind != FormatKind::cells) continue;
        has_model = true;
        const bool has_maps = is_plane && can_hold(output, FormatTrait::maps);
        if (has_maps && request.model_files.has_maps()) continue;
        options.refuse("-o", output.string(),
                       "only what grows on a model is written so, and " + message,
                       has_maps ? "--bake N writes a rectangle with maps of N texels" : hint);
    }
    check_cells_of_model(options, request);
    options.refuse_if(request.model_files.levels > 1, "--lods", message, hint);
    if (!is_plane) return check_without_surface(options, request);
    options.refuse_if(request.model_files.unwrap, "--unwrap", message, hint);
    options.refuse_if(writes_exr(request) && !request.model_files.has_maps(), "--exr",
                      "no maps are written", how_to_write_maps());
    options.refuse_if(request.model_files.has_maps() && !has_model, option_of_maps(request),
                      "no model is written with its maps",
                      output_of(FormatTrait::maps) + " writes a rectangle with them");
}

}  // namespace cascade
