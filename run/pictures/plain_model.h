// An unchanged model, with its file's data at points, as a file for another program.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

/// Writes a mesh with its colours and numbers, as write_model() of export/ does. Returns sentences
/// about data that the format cannot hold. Fails if memory is short, too.
Result<std::vector<std::string>> write_plain_model(const std::filesystem::path& path,
                                                   const SurfaceMesh& mesh);

}  // namespace cascade
