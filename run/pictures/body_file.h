// The body of a volume as a model for other programs.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "export/model_writer.h"
#include "run/pictures/written_files.h"

#include <filesystem>

namespace cascade {

/// Writes a body (run/pictures/body_picture.h) with the colours and numbers of its points, and its
/// levels of detail, as write_levels() does, with lengths in the unit of the grid's spacing. Fails
/// on an empty body, as write_levels() does, and if memory is short.
Result<WrittenFiles> write_body(const std::filesystem::path& path, const SurfaceMesh& body,
                                const Grid& grid, const PointResults& results, int levels);

}  // namespace cascade
