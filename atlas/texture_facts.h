// Facts about texture coordinates.
#pragma once

#include "mesh/surface_mesh.h"

#include <cstddef>

namespace cascade {

struct TextureFacts {
    /// Connected parts: a common edge of two triangles has the same coordinates in both.
    std::size_t charts = 0;
    /// Fractions of the texture, which repeats: covered by any triangle, and by more than one.
    double covered = 0, shared = 0;
    /// The fraction of the surface whose picture is mirrored.
    double mirrored = 0;
    /// The mean, weighted by area, and the largest change of lengths (atlas/chart.h, distortion),
    /// relative to a scale at which all triangles together keep their area. Both ≥ 1. Skips
    /// triangles whose picture has no area. Mirrored triangles count as if they were not.
    double mean = 1, worst = 1;
    /// Triangles that cannot be drawn: without area in the texture, and with coordinates that are
    /// not finite or too large (atlas/texture_layout.h).
    std::size_t without_area = 0, without_place = 0;
};

/// Facts about the coordinates of a mesh that has some, from 1024 × 1024 samples. Throws
/// std::bad_alloc.
TextureFacts texture_facts(const SurfaceMesh& mesh);

}  // namespace cascade
