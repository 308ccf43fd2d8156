// Facts about texture coordinates.
#pragma once

#include "mesh/surface_mesh.h"

#include <cstddef>

namespace cascade {

struct TextureFacts {
    /// The number of connected parts. Two triangles are connected if their common edge has the same
    /// coordinates in both.
    std::size_t charts = 0;
    /// The fraction of the texture that triangles cover, and the fraction that several triangles
    /// cover. The texture repeats.
    double covered = 0, shared = 0;
    /// The fraction of the surface whose image in the texture is mirrored.
    double mirrored = 0;
    /// The mean distortion of the triangles, weighted by area, and the largest (see distortion() in
    /// atlas/chart.h). Both are ≥ 1. The texture is scaled so that all triangles together keep
    /// their area. Skips triangles whose image has no area. Mirrored triangles count as if they
    /// were not mirrored.
    double mean = 1, worst = 1;
    /// The numbers of triangles that cannot be drawn: those without area in the texture, and those
    /// whose coordinates are not finite or too large (atlas/texture_layout.h).
    std::size_t without_area = 0, without_place = 0;
};

/// Finds facts about the texture coordinates of a mesh, which must have some, with 1024 × 1024
/// samples. Throws std::bad_alloc.
TextureFacts texture_facts(const SurfaceMesh& mesh);

}  // namespace cascade
