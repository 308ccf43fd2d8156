// The intrinsic Delaunay triangulation of a surface.
#pragma once

#include "mesh/surface_mesh.h"

#include <array>
#include <vector>

namespace cascade {

/// Triangles that bend over the edges of a surface, defined by the lengths of their sides.
struct IntrinsicMesh {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<TriangleEdge, 3>> across;  ///< As in SurfaceMesh.
    std::vector<std::array<double, 3>> lengths;       ///< The lengths of each triangle's edges.

    double area(std::uint32_t triangle) const;
    /// The cotangent of the angle opposite an edge.
    double cotangent(TriangleEdge edge) const;
};

/// Flips edges until no two angles opposite an edge exceed 180° together, which makes all cotangent
/// weights non-negative except at boundaries: A. Bobenko and B. Springborn, "A Discrete
/// Laplace–Beltrami Operator for Simplicial Surfaces", Discrete & Computational Geometry 38 (2007),
/// by the algorithm of M. Fisher et al., "An Algorithm for the Construction of Intrinsic Delaunay
/// Triangulations with Applications to Digital Geometry Processing", Computing 81 (2007). Triangles
/// may end up with two corners at one point, which OpenMesh does not support, so this does not use
/// HalfEdges. Stops flipping if rounding would make it endless.
IntrinsicMesh intrinsic_delaunay(const SurfaceMesh& mesh);

}  // namespace cascade
