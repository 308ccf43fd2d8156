// Which edges of triangles lie against each other, and which way round triangles are to turn.
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

/// Pairs the edges between the same two points. Where more than two triangles meet, first those
/// that are connected elsewhere are paired, so that a solid with a fin stays closed; then those
/// that turn the same way, and of these the ones that continue each other most smoothly. One that
/// is left over ends there.
EdgePairs pair_edges(std::span<const Vector3d> points,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// A mesh of triangles that fit together and turn the same way already: links are all that is
/// added.
SurfaceMesh mesh_of(std::vector<Vector3d> points,
                    std::vector<std::array<std::uint32_t, 3>> triangles);

struct Orientation {
    std::vector<bool> is_turned;  ///< Per triangle: its corners are to be taken the other way.
    std::size_t turned = 0;       ///< How many, but for components that were turned as a whole.
    std::size_t cut_edges = 0;    ///< Pairs that were given up: the surface had one side only.
    std::size_t inside_out = 0;   ///< Closed components that were turned as a whole.
};

/// Makes the triangles of each component turn the same way: that of the larger part of its area,
/// and outwards where it is closed. Pairs of a one-sided surface that cannot fit are taken apart.
Orientation orient(std::span<const Vector3d> points,
                   std::span<const std::array<std::uint32_t, 3>> triangles,
                   std::vector<std::array<TriangleEdge, 3>>& across);

}  // namespace cascade
