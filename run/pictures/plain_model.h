// Writes a model without a pattern for another program, with the attributes that its file gives to
// its points.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

/// Writes a mesh with its colours and numbers by write_model() of export/. Returns sentences about
/// data that the format cannot hold. Fails in the same cases as write_model(), and if memory is
/// exhausted.
Result<std::vector<std::string>> write_plain_model(const std::filesystem::path& path,
                                                   const SurfaceMesh& mesh);

}  // namespace cascade
