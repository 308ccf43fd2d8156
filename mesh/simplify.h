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
    std::span<const std::array<float, 3>> values;  ///< One per point. Empty if there is no pattern.
    /// The distance on the surface that counts as much as a difference of 1 in one of the numbers.
    double length = 0;
};

struct Simplified {
    /// The result. Its points are points of the original, in their order, with their attributes.
    /// Triangles have no texture coordinates and no faces.
    SurfaceMesh mesh;
    /// The point of the original for each point of the result.
    std::vector<std::uint32_t> points;
    /// The point of the result into which each point of the original has merged.
    std::vector<std::uint32_t> merged;
};

/// The surface with about `triangles` triangles, at most one more. Collapses edges into one of
/// their ends, in order of least change to the surface and the pattern. Components, handles and
/// boundaries remain, and corners of boundaries stay. If every further collapse would change one of
/// these or fold triangles over, more triangles remain. Values that are not finite count as 0. The
/// result is the same in every run.
///
/// Fails as half_edges() does. Throws std::bad_alloc. The result is meaningless if `cancel` became
/// true.
Result<Simplified> simplify(const SurfaceMesh& mesh, std::size_t triangles,
                            const KeptPattern& pattern, const std::atomic<bool>& cancel);

}  // namespace cascade
