// Pairing of the edges of triangles, and consistent orientation.
#pragma once

#include "mesh/surface_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

struct EdgePairs {
    std::vector<std::array<TriangleEdge, 3>> across;  ///< As in SurfaceMesh.
    std::size_t non_manifold_edges = 0;               ///< Edges of more than two triangles.
};

/// Pairs the edges between the same two points. If more than two triangles meet, pairs triangles
/// connected elsewhere first, so that a solid with a fin stays closed, and then those with
/// consistent orientation, the most nearly coplanar first. A remaining edge becomes a boundary.
EdgePairs pair_edges(std::span<const Vector3d> points,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Adds adjacency to triangles that are already manifold and consistently oriented.
SurfaceMesh mesh_of(std::vector<Vector3d> points,
                    std::vector<std::array<std::uint32_t, 3>> triangles);

struct Orientation {
    std::vector<bool> is_turned;  ///< Triangles whose corners must be reversed.
    std::size_t turned = 0;       ///< Their number, without components reversed as a whole.
    std::size_t cut_edges = 0;    ///< Pairs separated because the surface was one-sided.
    std::size_t inside_out = 0;   ///< Closed components reversed as a whole.
};

/// Orients the triangles of each component consistently: outwards if it is closed, otherwise like
/// the larger part of its area. Separates inconsistent pairs of a one-sided surface.
Orientation orient(std::span<const Vector3d> points,
                   std::span<const std::array<std::uint32_t, 3>> triangles,
                   std::vector<std::array<TriangleEdge, 3>>& across);

}  // namespace cascade
