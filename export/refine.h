// Refines a mesh for files that can only have vertex colours.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The part of a triangle of the original mesh that a triangle of the refined mesh covers.
struct TriangleOrigin {
    std::uint32_t triangle = 0;
    /// The weights of the original triangle's corners at each corner of the refined triangle.
    std::array<std::array<double, 3>, 3> corners;

    /// The position on the original mesh that has the given weights of the refined triangle's
    /// corners.
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

/// Halves edges longer than `longest_edge` (positive) and splits the triangles at them, until no
/// such edge is left or the mesh would have more than `most_triangles`. The mesh's own points come
/// first, unchanged. Texture coordinates and attributes of new points are interpolated. Throws
/// std::bad_alloc.
RefinedMesh refined(const SurfaceMesh& mesh, double longest_edge, std::size_t most_triangles);

/// Moves each point along its normal by its height, in the unit of the mesh. Heights that are not
/// finite count as 0.
void displace(SurfaceMesh& mesh, std::span<const Vector3d> normals, std::span<const float> heights);

}  // namespace cascade
