// Simplification of surfaces for levels of detail, by OpenMesh's decimater.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// A pattern that simplify() preserves: up to three numbers at each point, such as a colour.
struct KeptPattern {
    std::span<const std::array<float, 3>> values;  ///< One per point. Empty if there is none.
    /// A difference of 1 in a number counts as much as a distance of this length.
    double length = 0;
};

struct Simplified {
    /// Its points are points of the original, in their order, with their attributes. Triangles have
    /// no texture coordinates and no faces.
    SurfaceMesh mesh;
    std::vector<std::uint32_t> points;  ///< The original's point for each point.
    /// For each point of the original, the point of the result into which it has merged.
    std::vector<std::uint32_t> merged;
};

/// The surface with about `triangles` triangles, at most one more. Collapses edges into one of
/// their ends, in order of least change to the surface and the pattern. Components, handles and
/// boundaries remain, and corners of boundaries stay. More triangles are left where a collapse
/// would change these or fold triangles. Values that are not finite count as 0. The result is the
/// same in every run.
///
/// Fails as half_edges() does. Throws std::bad_alloc. Meaningless if `cancel` became true.
Result<Simplified> simplify(const SurfaceMesh& mesh, std::size_t triangles,
                            const KeptPattern& pattern, const std::atomic<bool>& cancel);

}  // namespace cascade
