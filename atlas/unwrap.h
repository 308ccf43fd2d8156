// Makes texture coordinates for surfaces that have none.
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

/// The coordinates of each triangle's corners.
using MeshTexture = std::vector<std::array<TexturePlace, 3>>;

/// Coordinates for each triangle's corners, in 0 … 1, without overlaps, for a square texture with
/// `texels` texels along a side, 1 … 8192. The surface is cut into charts whose triangles nearly
/// keep their shapes and relative sizes. The distance between charts is 1/512 of the side, but at
/// least two texels, or one texel if there are very many charts. Fails if the charts do not fit
/// even then. Throws std::bad_alloc. The result has the same bits with any number of threads. It is
/// meaningless if `cancel` became true.
Result<MeshTexture> unwrap(const SurfaceMesh& mesh, std::int64_t texels, Team& team,
                           const std::atomic<bool>& cancel);

}  // namespace cascade
