// Patterns on models as the files of `-o`: models, cells and baked maps for other programs.
#pragma once

#include "atlas/unwrap.h"
#include "core/file_format.h"
#include "core/result.h"
#include "export/levels.h"
#include "export/material_maps.h"
#include "picture/image.h"
#include "run/domain/model_cells.h"
#include "run/pictures/written_files.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

class CellFilter;
struct ModelLook;
struct RefinedMesh;

struct ModelFileOptions {
    bool retile = false;    ///< Triangulate the cells instead of refining the model's triangles.
    std::int64_t bake = 0;  ///< The side of the maps of GLB files in texels. 0 if not known yet.
    double texels_per_cell = 0;  ///< Along a cell, to choose `bake`. 0 if `bake` is given.
    bool animate = false;        ///< GLB files show the growth of the model.
    bool merge = false;          ///< Crawling cells are plain triangles instead of instances.
    bool unwrap = false;         ///< Make texture coordinates, even if the model has some.
    MapFormat map_format = MapFormat::png;  ///< For the maps beside GLB files.
    int levels = 1;  ///< Levels of detail, each with a quarter of the triangles of the one before.
    static constexpr int most_levels = 8;
    static constexpr std::int64_t most_texels = 8192;
    bool has_maps() const { return bake > 0 || texels_per_cell > 0; }
    /// True if this file gets maps.
    bool is_baked(const std::filesystem::path& path) const;
    /// True if this file shows the growth.
    bool is_animated(const std::filesystem::path& path) const;
};

/// Whether files of a model need texture coordinates that have not been made.
inline bool needs_texture(const SurfaceMesh& mesh, const ModelFileOptions& options) {
    return options.unwrap || (options.has_maps() && mesh.texture.empty());
}
/// The side of maps for these coordinates, estimated for this number of cells if it is not known
/// yet.
std::int64_t texture_side(const ModelFileOptions& options, std::int64_t cells);
/// Makes them, as unwrap() does, for maps with this side in texels. Fails if memory is short, too.
Result<MeshTexture> made_texture(const SurfaceMesh& mesh, std::int64_t side, Team& team,
                                 const std::atomic<bool>& cancel);

/// The mesh in the coordinates of the model's file, with this texture unless it is empty.
SurfaceMesh mesh_in_files(const ModelCells& model, const MeshTexture& texture);

/// The appearance of a model at moments of a run, the last one last.
struct ModelGrowth {
    static constexpr std::size_t most = 64;  ///< Of moments.
    std::size_t count = 0;
    std::function<Result<ModelLook>(std::size_t number)> look;
    double seconds = 0;  ///< From one moment to the next.
};

/// Writes a GLB file that shows the growth: the mesh, refined as for colours, appears as `last`,
/// and its animation begins with moment 0 and ends with moment growth.count − 1, which is `last`.
/// Fails as encode_growing_glb() does, and if memory is short.
Result<void> write_growing_model(const std::filesystem::path& path, const ModelCells& model,
                                 const MeshTexture& texture, const ModelLook& last,
                                 const ModelGrowth& growth);

/// Writes the state at one moment. Objects passed to it must outlive it.
class ModelFileWriter {
public:
    /// `texture` are the model's texture coordinates in files. If it is empty they stay unchanged.
    /// `channels` are numbers of cells to write besides colours. `texts` are written into maps.
    /// Throws std::bad_alloc.
    ModelFileWriter(const ModelCells& model, const MeshTexture& texture, const ModelLook& look,
                    std::vector<Channel> channels, const ModelFileOptions& options, PngTexts texts);
    ~ModelFileWriter();

    /// Writes a model or cells, with the available levels and maps. Fails as the writers of export/
    /// do.
    Result<WrittenFiles> write(const std::filesystem::path& path);

private:
    Result<WrittenFiles> write_one(const std::filesystem::path& path);
    Result<void> write_cells(const std::filesystem::path& path);
    Result<WrittenFiles> write_with_levels(const std::filesystem::path& path);
    Result<void> make_levels();
    Result<std::vector<ModelLevel>> simplified_levels();
    const CellFilter& filter();
    const RefinedMesh& refined();  ///< Raised by its heights if the look displaces.

    const ModelCells& model_;
    SurfaceMesh changed_;      ///< Empty if files have the model unchanged.
    const SurfaceMesh& mesh_;  ///< In the coordinates of the model's file, like all outputs.
    const ModelLook& look_;
    std::vector<Channel> channels_;
    ModelFileOptions options_;
    PngTexts texts_;
    Team team_;
    // Made on the first use.
    std::unique_ptr<CellFilter> filter_;
    std::unique_ptr<RefinedMesh> refined_;  ///< Displaced, if requested.
    std::vector<ModelLevel> levels_;        ///< The finest one first.
};

}  // namespace cascade
