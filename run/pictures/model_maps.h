// Writes baked models, which show a pattern in maps. Each level of detail has its own maps.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/pictures/model_files.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/written_files.h"

#include <filesystem>

namespace cascade {

/// The mesh for which maps are drawn.
struct MappedSurface {
    /// The mesh in the coordinates of the file, with texture coordinates.
    const SurfaceMesh& mesh;
    const SurfaceCells& cells;
    const CellFilter& filter;
    /// The mesh that the heights of the look have raised. Null if heights do not move the surface.
    const RefinedMesh* displaced;
};

/// Writes a GLB file with maps of options.bake texels along a side, and the maps as files in the
/// same folder. A displaced surface has no maps of heights and normals, because its shape contains
/// both. Each coarser level has its own texture coordinates, maps half as wide as the maps of the
/// previous level, and the normals of the finest surface. A coarser level is also written to a GLB
/// file of its own. Fails in the same cases as bake() and write_maps() of export/.
Result<WrittenFiles> write_model_maps(const std::filesystem::path& path,
                                      const MappedSurface& surface, const ModelLook& look,
                                      const ModelFileOptions& options, const PngTexts& texts,
                                      Team& team);

/// Returns the paths of the files that write_model_maps() writes for a level. Level 0 is the model
/// itself. `said` contains the maps that the script sets. `displaces` says whether heights move the
/// surface.
std::vector<std::filesystem::path> map_paths_of_level(const std::filesystem::path& path,
                                                      std::size_t level, const MapSet& said,
                                                      bool displaces, MapFormat format);

}  // namespace cascade
