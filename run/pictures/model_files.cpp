// Chooses between refined, retiled and baked models; meshes and filters are made once for all
// files.
#include "run/pictures/model_files.h"

#include "core/enough_memory.h"
#include "export/bake.h"
#include "export/cell_writer.h"
#include "export/model_writer.h"
#include "export/point_values.h"
#include "export/refine.h"
#include "film/film.h"
#include "run/pictures/model_occlusion.h"
#include "run/pictures/model_picture.h"
#include "surface/blur_cells.h"
#include "surface/retile.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

// Between points colours are linear: at this distance, in cell spacings, they follow the filter,
// whose radius is two.
constexpr double colour_distance = 0.75;
constexpr std::size_t most_triangles = std::size_t{1} << 23;

static_assert(ModelFileOptions::most_texels == BakeOptions::largest_texture);

/// A sentence about maps of this side that are far finer than what cells show; "" if they are not.
std::string describe_spare_texels(std::int64_t side, double texels_of_cell) {
    constexpr double most = 16, enough = 4;  // Along a side of a cell.
    const double along = std::sqrt(texels_of_cell);
    if (!(along > most)) return {};
    const auto needed = static_cast<std::uint64_t>(static_cast<double>(side) * enough / along);
    return fmt::format(
        "a cell is {:.0f} texels wide in maps of {} texels: '--bake {}' shows as much, and more "
        "cells show more",
        along, side, std::bit_ceil(needed));
}

}  // namespace

std::optional<OutputKind> output_kind(const std::filesystem::path& path) {
    const std::string ending = lower_ending(path);
    if (ending == ".png") return OutputKind::picture;
    if (ending == ".svg" || ending == ".pdf") return OutputKind::figure;
    if (film_format(path)) return OutputKind::film;
    if (ending == ".npz") return OutputKind::cells;
    if (ending == ".vtp" && lower_ending(path.stem()) == ".cells") {
        return OutputKind::cells;
    }
    if (is_model_ending(path)) return OutputKind::model;
    return std::nullopt;
}

bool holds_texture(const std::filesystem::path& path) {
    const std::string ending = lower_ending(path);
    return ending == ".glb" || ending == ".obj" || ending == ".ply";
}

RefinedMesh refined_for_colours(const SurfaceMesh& mesh, const SurfaceCells& cells) {
    return refined(mesh, colour_distance * cell_spacing(cells), most_triangles);
}

bool ModelFileOptions::is_baked(const std::filesystem::path& path) const {
    return bake > 0 && lower_ending(path) == ".glb";
}

Result<MeshTexture> made_texture(const SurfaceMesh& mesh, const ModelFileOptions& options,
                                 Team& team, const std::atomic<bool>& cancel) {
    return enough_memory_for(
        [&] { return unwrap(mesh, options.bake > 0 ? options.bake : usual_texels, team, cancel); },
        "there is not enough memory to make texture coordinates of the model");
}

namespace {

bool is_as_in_file(const ModelCells& model, const MeshTexture& texture) {
    return model.up == Axis::y && texture.empty();
}

}  // namespace

SurfaceMesh mesh_in_files(const ModelCells& model, const MeshTexture& texture) {
    SurfaceMesh mesh = model.mesh_of_file();
    if (!texture.empty()) mesh.texture = texture;
    return mesh;
}

ModelFileWriter::ModelFileWriter(const ModelCells& model, const MeshTexture& texture,
                                 const ModelLook& look, std::vector<Channel> channels,
                                 const ModelFileOptions& options, PngTexts texts)
    : model_(model),
      changed_(is_as_in_file(model, texture) ? SurfaceMesh() : mesh_in_files(model, texture)),
      mesh_(is_as_in_file(model, texture) ? model.mesh : changed_),
      look_(look),
      channels_(std::move(channels)),
      options_(options),
      texts_(std::move(texts)),
      team_(hardware_threads()) {}

Result<void> write_plain_model(const std::filesystem::path& path, const SurfaceMesh& mesh) {
    return enough_memory_for([&] { return write_model(path, mesh, {}); },
                             "cannot write '" + path.string() + "': there is not enough memory");
}

ModelFileWriter::~ModelFileWriter() = default;

const CellFilter& ModelFileWriter::filter() {
    if (!filter_) filter_ = std::make_unique<CellFilter>(mesh_, model_.spread().cells, team_);
    return *filter_;
}

Result<std::vector<std::filesystem::path>> ModelFileWriter::write(
    const std::filesystem::path& path) {
    const auto write_one = [&]() -> Result<std::vector<std::filesystem::path>> {
        if (options_.is_baked(path) && output_kind(path) != OutputKind::cells) {
            return write_maps(path);
        }
        const auto written = output_kind(path) == OutputKind::cells ? write_cells(path)
                             : options_.retile                      ? write_retiled(path)
                                                                    : write_refined(path);
        if (!written) return tl::unexpected(written.error());
        return std::vector{path};
    };
    return enough_memory_for(write_one,
                             "cannot write '" + path.string() + "': there is not enough memory");
}

Result<void> ModelFileWriter::write_cells(const std::filesystem::path& path) {
    std::vector<Colour> colours;
    for (std::size_t k = 0; k < model_.count(); ++k) {
        colours.push_back(look_.colour_of(k, model_.spread().cells.places[k]));
    }
    return cascade::write_cells(path, mesh_, model_.spread().cells, {colours, channels_});
}

Result<void> ModelFileWriter::write_refined(const std::filesystem::path& path) {
    if (!refined_) {
        refined_ = std::make_unique<RefinedMesh>(refined_for_colours(mesh_, model_.spread().cells));
    }
    PaintedCells painted = look_.painted();
    painted.heights = {};
    painted.material = {};
    return write_model(path, refined_->mesh,
                       {colours_at(refined_->places, filter(), painted, team_),
                        values_at(refined_->places, filter(), channels_, team_)});
}

/// Points at cells take the cells' values without filtering.
Result<void> ModelFileWriter::write_retiled(const std::filesystem::path& path) {
    const std::size_t count = model_.count();
    if (!retiled_) {
        const std::atomic<bool> never = false;
        auto made = retile(mesh_, model_.spread().cells.places, never);
        if (!made) return tl::unexpected(made.error());
        retiled_ = std::make_unique<Retiled>(*std::move(made));
    }
    const std::size_t points = retiled_->mesh.points.size();
    std::vector<float> values(look_.channels * points), of_cells(count);
    for (std::size_t c = 0; c < look_.channels; ++c) {
        for (std::size_t k = 0; k < count; ++k) of_cells[k] = look_.values[look_.channels * k + c];
        const PointAttribute whole = attribute_of(*retiled_, "", of_cells);
        for (std::size_t p = 0; p < points; ++p) values[look_.channels * p + c] = whole.values[p];
    }
    const std::vector<SurfacePlace> of_points = places_of_points(mesh_);
    std::vector<Colour> colours;
    for (std::size_t p = 0; p < points; ++p) {
        const SurfacePlace& place = p < count ? model_.spread().cells.places[p]
                                              : of_points[retiled_->kept[p - count].old_point];
        colours.push_back(
            look_.colour(std::span(values).subspan(look_.channels * p, look_.channels), place));
    }
    std::vector<Channel> channels;
    for (const Channel& channel : channels_) {
        channels.push_back(attribute_of(*retiled_, channel.name, channel.values));
    }
    return write_model(path, retiled_->mesh, {colours, channels});
}

Result<std::vector<std::filesystem::path>> ModelFileWriter::write_maps(
    const std::filesystem::path& path) {
    BakeOptions options;
    options.width = options.height = options_.bake;
    PaintedCells painted = look_.painted();
    std::vector<float> occlusion;
    if (!look_.heights.empty()) {
        occlusion = model_occlusion(mesh_, model_.spread().cells, filter(), look_.heights, team_);
        painted.material[MaterialPart::occlusion] = occlusion;
    }
    const std::atomic<bool> never = false;
    const auto baked = bake(mesh_, filter(), painted, options, team_, never);
    if (!baked) return tl::unexpected(baked.error());
    for (const std::string& warning : baked->warnings) warnings_.push_back(warning);
    for (const std::string& doubt : look_.material.doubts) warnings_.push_back(doubt);
    const double texels = baked->covered * static_cast<double>(options_.bake * options_.bake);
    std::string doubt =
        describe_spare_texels(options_.bake, texels / static_cast<double>(model_.count()));
    if (!doubt.empty()) warnings_.push_back(std::move(doubt));
    if (auto done = cascade::write_maps(path, mesh_, *baked, texts_); !done) {
        return tl::unexpected(done.error());
    }
    return map_paths(path, baked->maps);
}

}  // namespace cascade
