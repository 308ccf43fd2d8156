// Patterns on a plane, or on a slice of a volume, as maps that repeat where the plane does.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/pictures/written_files.h"

#include <filesystem>

namespace cascade {

struct ModelFileOptions;
struct PlaneLook;

/// Writes a rectangle with maps, the longer side with options.bake texels, as a GLB file, and the
/// maps beside it (export/material_maps.h).
Result<WrittenFiles> write_plane(const std::filesystem::path& path, const PlaneLook& look,
                                 const ModelFileOptions& options, const PngTexts& texts);

}  // namespace cascade
