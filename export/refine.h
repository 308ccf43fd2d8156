// Refines a mesh for files that only have vertex colours.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The position of a refined mesh's triangle in a triangle of the original mesh.
struct TriangleOrigin {
    std::uint32_t triangle = 0;
    std::array<std::array<double, 3>, 3> corners;  ///< Weights at each corner.

    /// The position in the original mesh, given weights of the part's corners.
    SurfacePlace at(const std::array<double, 3>& weights) const {
        SurfacePlace place{triangle, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t c = 0; c < 3; ++c) place.weights[c] += weights[k] * corners[k][c];
        }
        return place;
    }
};

struct RefinedMesh {
    SurfaceMesh mesh;
    std::vector<SurfacePlace> places;     ///< Each point's position in the original mesh.
    std::vector<TriangleOrigin> origins;  ///< One per triangle.
};

/// Halves edges longer than `longest_edge` (positive), splitting the triangles at them, until none
/// is left or the mesh would exceed `most_triangles`. The mesh's points come first, unchanged.
/// Texture coordinates and attributes of new points are interpolated. Throws std::bad_alloc.
RefinedMesh refined(const SurfaceMesh& mesh, double longest_edge, std::size_t most_triangles);

/// Moves each point along its normal by its height, in lengths of the mesh. Non-finite heights
/// count as 0.
void displace(SurfaceMesh& mesh, std::span<const Vector3d> normals, std::span<const float> heights);

}  // namespace cascade
