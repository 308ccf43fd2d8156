// Baked models: a pattern on a model as maps, and levels of detail with maps of their own.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/pictures/model_files.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/written_files.h"

#include <filesystem>

namespace cascade {

/// The mesh that maps are drawn on.
struct MappedSurface {
    const SurfaceMesh& mesh;  ///< With texture coordinates, in the coordinates of the file.
    const SurfaceCells& cells;
    const CellFilter& filter;
    const RefinedMesh* displaced;  ///< The mesh raised by the heights of the look, or none.
};

/// Writes a GLB file with maps of options.bake texels along a side, and the maps beside it. A
/// displaced surface has no maps of heights and normals, which are in its shape. Coarser levels
/// have their own texture coordinates, maps half as wide as the level before, and normals of the
/// finest surface. Each is also written to separate files. Fails as bake() and write_maps() of
/// export/ do.
Result<WrittenFiles> write_model_maps(const std::filesystem::path& path,
                                      const MappedSurface& surface, const ModelLook& look,
                                      const ModelFileOptions& options, const PngTexts& texts,
                                      Team& team);

/// The files that write_model_maps makes for level k, 0 being the model itself. `said` are the maps
/// set in the script, and `displaces` says that heights raise the surface.
std::vector<std::filesystem::path> map_paths_of_level(const std::filesystem::path& path,
                                                      std::size_t level, const MapSet& said,
                                                      bool displaces, MapFormat format);

}  // namespace cascade
