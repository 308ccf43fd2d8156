// The intrinsic Delaunay triangulation of a surface.
#pragma once

#include "mesh/surface_mesh.h"

#include <array>
#include <vector>

namespace cascade {

/// Triangles that are given by the lengths of their edges. In space they may bend over the edges of
/// the surface.
struct IntrinsicMesh {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The adjacent edges, as in SurfaceMesh::across.
    std::vector<std::array<TriangleEdge, 3>> across;
    std::vector<std::array<double, 3>> lengths;  ///< The lengths of each triangle's edges.

    double area(std::uint32_t triangle) const;
    /// The cotangent of the angle opposite an edge.
    double cotangent(TriangleEdge edge) const;
};

/// Flips edges until the two angles opposite each edge sum to at most 180°. All cotangent weights
/// are then non-negative except at boundaries: A. Bobenko and B. Springborn, "A Discrete
/// Laplace–Beltrami Operator for Simplicial Surfaces", Discrete & Computational Geometry 38 (2007).
/// The algorithm is by M. Fisher et al., "An Algorithm for the Construction of Intrinsic Delaunay
/// Triangulations with Applications to Digital Geometry Processing", Computing 81 (2007). The
/// result may have triangles with two corners at one point. OpenMesh does not support such
/// triangles, so this function does not use HalfEdges. Limits the number of flips, because rounding
/// could make flips go on forever.
IntrinsicMesh intrinsic_delaunay(const SurfaceMesh& mesh);

}  // namespace cascade
