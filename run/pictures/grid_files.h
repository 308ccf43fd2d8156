// Patterns on grids as the files of `-o`: the body of a volume as a model for other programs, and a
// plane, or a slice of a volume, as maps that repeat where the plane does.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "export/model_writer.h"
#include "picture/image.h"
#include "run/pictures/written_files.h"

#include <filesystem>

namespace cascade {

struct ModelFileOptions;
struct PlaneLook;

/// Writes a body (run/pictures/body_picture.h) with the colours and numbers of its points, and its
/// levels of detail, as write_levels() does, with lengths in the unit of the grid's spacing. Fails
/// on an empty body, as write_levels() does, and if memory is short.
Result<WrittenFiles> write_body(const std::filesystem::path& path, const SurfaceMesh& body,
                                const Grid& grid, const PointResults& results, int levels);

/// Writes a rectangle with maps, of which the longer side has options.bake texels, as a GLB file,
/// and the maps beside it (export/material_maps.h).
Result<WrittenFiles> write_plane(const std::filesystem::path& path, const PlaneLook& look,
                                 const ModelFileOptions& options, const PngTexts& texts);

}  // namespace cascade
