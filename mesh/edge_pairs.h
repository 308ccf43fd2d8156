// Pairs the edges of triangles, and orients triangles consistently.
#pragma once

#include "mesh/surface_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

struct EdgePairs {
    /// The adjacent edges, as in SurfaceMesh::across.
    std::vector<std::array<TriangleEdge, 3>> across;
    std::size_t non_manifold_edges = 0;  ///< Number of edges with more than two triangles.
};

/// Pairs the edges that join the same two points. Where more than two triangles meet at an edge,
/// first pairs triangles that are also connected elsewhere, so that a solid with a fin stays
/// closed. Then pairs triangles with consistent orientation, beginning with the pair that is
/// closest to coplanar. An edge left without a partner becomes a boundary.
EdgePairs pair_edges(std::span<const Vector3d> points,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Adds adjacency to triangles that are already manifold and consistently oriented.
SurfaceMesh mesh_of(std::vector<Vector3d> points,
                    std::vector<std::array<std::uint32_t, 3>> triangles);

struct Orientation {
    std::vector<bool> is_turned;  ///< Whether the corners of each triangle must be reversed.
    /// Number of turned triangles, not counting components that are reversed as a whole.
    std::size_t turned = 0;
    std::size_t cut_edges = 0;   ///< Number of pairs separated to cut one-sided surfaces.
    std::size_t inside_out = 0;  ///< Number of closed components reversed as a whole.
};

/// Orients the triangles of each component consistently. A closed component faces outwards. Any
/// other component keeps the orientation that most of its area has. Cuts a one-sided surface at
/// pairs that remain inconsistent.
Orientation orient(std::span<const Vector3d> points,
                   std::span<const std::array<std::uint32_t, 3>> triangles,
                   std::vector<std::array<TriangleEdge, 3>>& across);

}  // namespace cascade
