// Writes patterns on grids to the files of option `-o`. The body of a volume becomes a model. A
// plane, or a slice of a volume, becomes a rectangle with maps, which repeat along the axes in
// which the plane is periodic.
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

/// Writes a body (run/pictures/body_picture.h) with colours and numbers at its points, and with
/// `levels` levels of detail. Lengths are in the unit of the grid's spacing. Fails if the body is
/// empty or memory is exhausted, and in the same cases as write_levels().
Result<WrittenFiles> write_body(const std::filesystem::path& path, const SurfaceMesh& body,
                                const Grid& grid, const PointResults& results, int levels);

/// Writes a rectangle as a GLB file with maps, and the maps as files in the same folder
/// (export/material_maps.h). The longer side of the maps has options.bake texels.
Result<WrittenFiles> write_plane(const std::filesystem::path& path, const PlaneLook& look,
                                 const ModelFileOptions& options, const PngTexts& texts);

}  // namespace cascade
