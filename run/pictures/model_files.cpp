// Chooses between refined, retiled and baked models. Each mesh and filter is made only once, and
// all files use it.
#include "run/pictures/model_files.h"

#include "core/enough_memory.h"
#include "core/file_format.h"
#include "core/run_control.h"
#include "export/cell_writer.h"
#include "export/model_writer.h"
#include "export/point_values.h"
#include "run/pictures/map_size.h"
#include "run/pictures/model_maps.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/nested_tiling.h"
#include "run/pictures/refined_model.h"
#include "surface/blur_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// The fraction of a map that texture coordinates made by Cascade usually cover.
constexpr double usual_cover = 0.6;

}  // namespace

std::int64_t texture_side(const ModelFileOptions& options, std::int64_t cells) {
    if (options.texels_per_cell > 0) {
        return std::min(map_side(options.texels_per_cell, cells, usual_cover),
                        ModelFileOptions::most_texels);
    }
    return options.bake > 0 ? options.bake : usual_texels;
}

Result<MeshTexture> made_texture(const SurfaceMesh& mesh, std::int64_t side, Team& team,
                                 const std::atomic<bool>& cancel) {
    return enough_memory_for([&] { return unwrap(mesh, side, team, cancel); },
                             "there is not enough memory to make texture coordinates of the model");
}

namespace {

bool is_as_in_file(const ModelCells& model, const MeshTexture& texture) {
    return model.stance == Stance() && texture.empty();
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

ModelFileWriter::~ModelFileWriter() = default;

const CellFilter& ModelFileWriter::filter() {
    if (!filter_) filter_ = std::make_unique<CellFilter>(mesh_, model_.spread().cells, team_);
    return *filter_;
}

const RefinedMesh& ModelFileWriter::refined() {
    if (refined_) return *refined_;
    RefinedMesh fine = refined_for_colours(mesh_, model_.spread().cells);
    if (look_.displaces) {
        fine = raised_model(std::move(fine), mesh_, filter(), look_.heights, team_);
    }
    refined_ = std::make_unique<RefinedMesh>(std::move(fine));
    return *refined_;
}

Result<WrittenFiles> ModelFileWriter::write(const std::filesystem::path& path) {
    return enough_memory_for([&] { return write_one(path); },
                             "cannot write '" + path.string() + "': there is not enough memory");
}

Result<WrittenFiles> ModelFileWriter::write_one(const std::filesystem::path& path) {
    if (is_of_kind(path, FormatKind::cells)) {
        if (auto done = write_cells(path); !done) return tl::unexpected(done.error());
        return WrittenFiles{{path}, {}};
    }
    if (!options_.is_baked(path)) return write_with_levels(path);
    const MappedSurface surface{mesh_, model_.spread().cells, filter(),
                                look_.displaces ? &refined() : nullptr};
    return write_model_maps(path, surface, look_, options_, texts_, team_);
}

Result<void> ModelFileWriter::write_cells(const std::filesystem::path& path) {
    std::vector<Colour> colours;
    for (std::size_t k = 0; k < model_.count(); ++k) {
        colours.push_back(look_.colour_of(k, model_.spread().cells.places[k]));
    }
    return cascade::write_cells(path, mesh_, model_.spread().cells, {colours, channels_});
}

Result<WrittenFiles> ModelFileWriter::write_with_levels(const std::filesystem::path& path) {
    if (levels_.empty()) {
        if (auto made = make_levels(); !made) return tl::unexpected(made.error());
    }
    auto paths = write_levels(path, levels_);
    if (!paths) return tl::unexpected(paths.error());
    return WrittenFiles{*std::move(paths),
                        remarks_of_origin(path, origin_of_file(path, levels_.front().mesh))};
}

Result<void> ModelFileWriter::make_levels() {
    const SurfaceCells& cells = model_.spread().cells;
    auto levels = options_.retile
                      ? nested_tiling(mesh_, cells, look_, channels_, options_.levels, team_)
                      : simplified_levels();
    if (!levels) return tl::unexpected(levels.error());
    levels_ = *std::move(levels);
    return {};
}

Result<std::vector<ModelLevel>> ModelFileWriter::simplified_levels() {
    const PaintedCells painted = look_.painted_alone();
    const std::vector<SurfacePlace>& places = refined().places;
    return levels_of({refined().mesh, colours_at(places, filter(), painted, team_),
                      values_at(places, filter(), channels_, team_)},
                     options_.levels, 2 * cell_spacing(model_.spread().cells), never_cancelled);
}

}  // namespace cascade
