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

/// Pairs the edges between the same two points. If more than two triangles meet, triangles that are
/// connected elsewhere are paired first, so that a solid with a fin stays closed; then those with
/// consistent orientation, the most nearly coplanar first. A remaining edge becomes a boundary.
EdgePairs pair_edges(std::span<const Vector3d> points,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// A mesh of triangles that are manifold and oriented consistently already: only adds adjacency.
SurfaceMesh mesh_of(std::vector<Vector3d> points,
                    std::vector<std::array<std::uint32_t, 3>> triangles);

struct Orientation {
    std::vector<bool> is_turned;  ///< Per triangle: its corners are to be reversed.
    std::size_t turned = 0;       ///< Their number, without components reversed as a whole.
    std::size_t cut_edges = 0;    ///< Pairs that were separated because the surface was one-sided.
    std::size_t inside_out = 0;   ///< Closed components that were reversed as a whole.
};

/// Orients the triangles of each component consistently: outwards if it is closed, else like the
/// larger part of its area. Separates the pairs of a one-sided surface that do not fit.
Orientation orient(std::span<const Vector3d> points,
                   std::span<const std::array<std::uint32_t, 3>> triangles,
                   std::vector<std::array<TriangleEdge, 3>>& across);

}  // namespace cascade
