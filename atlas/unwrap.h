// Texture coordinates for surfaces that have none.
#pragma once

#include "core/parallel.h"
#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace cascade {

/// The default number of texels along a side.
inline constexpr std::int64_t usual_texels = 2048;

/// By corner of each triangle.
using MeshTexture = std::vector<std::array<TexturePlace, 3>>;

/// Coordinates for each triangle's corners, in 0 … 1, without overlaps, for a square texture with
/// `texels` along a side, 1 … 8192. The surface is cut into charts whose triangles nearly keep
/// their shapes and relative sizes. Charts are 1/512 of the side apart, but at least two texels, or
/// one if there are very many charts. Fails if even then they do not fit. Throws std::bad_alloc.
/// Meaningless if `cancel` became true. The same bits on any number of threads.
Result<MeshTexture> unwrap(const SurfaceMesh& mesh, std::int64_t texels, Team& team,
                           const std::atomic<bool>& cancel);

}  // namespace cascade
