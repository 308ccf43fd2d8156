// Writes patterns on models to the files of `-o`: models, cells and baked maps for other programs.
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
    /// Whether files get triangles between the cells, in place of refined triangles of the model.
    bool retile = false;
    /// The side, in texels, of the maps of GLB files. 0 if there are no maps or the side is not
    /// known yet.
    std::int64_t bake = 0;
    /// The requested width of a cell in texels, from which `bake` is computed. 0 if the user has
    /// given `bake` directly or wants no maps.
    double texels_per_cell = 0;
    bool animate = false;  ///< Whether GLB files show the growth of the pattern.
    /// Whether crawling cells are written as plain triangles. If not, they are written as
    /// instances.
    bool merge = false;
    bool unwrap = false;  ///< Whether new texture coordinates are made even if the model has some.
    /// The format of the files of maps, which are written into the folder of the GLB file.
    MapFormat map_format = MapFormat::png;
    /// The number of levels of detail. Each level has a quarter of the triangles of the level
    /// before.
    int levels = 1;
    static constexpr int most_levels = 8;
    static constexpr std::int64_t most_texels = 8192;
    bool has_maps() const { return bake > 0 || texels_per_cell > 0; }
    /// Whether this file gets maps.
    bool is_baked(const std::filesystem::path& path) const {
        return has_maps() && can_hold(path, FormatTrait::maps);
    }
    /// Whether this file shows the growth.
    bool is_animated(const std::filesystem::path& path) const {
        return animate && can_hold(path, FormatTrait::growth);
    }
};

/// Whether files of a model need texture coordinates that have not been made yet.
inline bool needs_texture(const SurfaceMesh& mesh, const ModelFileOptions& options) {
    return options.unwrap || (options.has_maps() && mesh.texture.empty());
}
/// Returns the side of the maps for which texture coordinates are made. If the side is not known
/// yet, it is estimated from the number of cells.
std::int64_t texture_side(const ModelFileOptions& options, std::int64_t cells);
/// Makes texture coordinates with unwrap(), for maps with `side` × `side` texels. Fails in the same
/// cases as unwrap(), and if memory is exhausted.
Result<MeshTexture> made_texture(const SurfaceMesh& mesh, std::int64_t side, Team& team,
                                 const std::atomic<bool>& cancel);

/// Returns the mesh in the coordinates of the model's file. `texture` replaces its texture
/// coordinates unless `texture` is empty.
SurfaceMesh mesh_in_files(const ModelCells& model, const MeshTexture& texture);

/// The appearance of a model at moments of a run, in the order of time.
struct ModelGrowth {
    static constexpr std::size_t most = 64;  ///< The largest number of moments.
    std::size_t count = 0;
    std::function<Result<ModelLook>(std::size_t number)> look;
    double seconds = 0;  ///< Seconds from one moment to the next.
};

/// Writes a GLB file that shows how the pattern grew. The mesh is refined for the colours and has
/// the material of `last`. Its animation runs from moment 0 to moment growth.count − 1, which must
/// look like `last`. Fails in the same cases as encode_growing_glb(), and if memory is exhausted.
Result<void> write_growing_model(const std::filesystem::path& path, const ModelCells& model,
                                 const MeshTexture& texture, const ModelLook& last,
                                 const ModelGrowth& growth);

/// Writes the pattern at one moment. All arguments of the constructor must outlive the writer.
class ModelFileWriter {
public:
    /// `texture` replaces the model's texture coordinates in files unless `texture` is empty.
    /// `channels` are numbers of cells that are written besides colours. `texts` are written into
    /// maps. Throws std::bad_alloc.
    ModelFileWriter(const ModelCells& model, const MeshTexture& texture, const ModelLook& look,
                    std::vector<Channel> channels, const ModelFileOptions& options, PngTexts texts);
    ~ModelFileWriter();

    /// Writes a model or its cells, with levels of detail and maps if they are requested and the
    /// format has them. Fails in the same cases as the writers of export/.
    Result<WrittenFiles> write(const std::filesystem::path& path);

private:
    Result<WrittenFiles> write_one(const std::filesystem::path& path);
    Result<void> write_cells(const std::filesystem::path& path);
    Result<WrittenFiles> write_with_levels(const std::filesystem::path& path);
    Result<void> make_levels();
    Result<std::vector<ModelLevel>> simplified_levels();
    const CellFilter& filter();
    /// Returns the mesh, refined for colours and raised by heights if look.displaces is true.
    const RefinedMesh& refined();

    const ModelCells& model_;
    /// The mesh in the coordinates of the model's file. Empty if files contain the model unchanged.
    SurfaceMesh changed_;
    /// The mesh in the coordinates of the model's file. Everything that is written has these
    /// coordinates.
    const SurfaceMesh& mesh_;
    const ModelLook& look_;
    std::vector<Channel> channels_;
    ModelFileOptions options_;
    PngTexts texts_;
    Team team_;
    // The following members are made when they are first needed.
    std::unique_ptr<CellFilter> filter_;
    /// The mesh, refined for colours and raised by heights if look.displaces is true.
    std::unique_ptr<RefinedMesh> refined_;
    std::vector<ModelLevel> levels_;  ///< The levels of detail, from the finest to the coarsest.
};

}  // namespace cascade
