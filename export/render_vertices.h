// Vertices for renderers, with one normal and one pair of texture coordinates each. Points on
// creases and texture seams become several vertices.
#pragma once

#include "mesh/normals.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// The frame of a normal map: the unit vector, perpendicular to the smooth normal, along which the
/// first texture coordinate grows, and whether the second one grows to its left (1) or to its right
/// (−1, if the texture is mirrored), seen from outside.
struct Tangent {
    Vector3d direction;
    int side = 1;
};

struct RenderVertices {
    std::vector<std::uint32_t> points;  ///< Points of the mesh, ascending, each at least once.
    std::vector<Vector3d> normals;      ///< One per vertex, of length 1.
    std::vector<TexturePlace> texture;  ///< Finite; empty if the mesh has none.
    std::vector<Tangent> tangents;      ///< Likewise.
    /// The triangles of the mesh, in order.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Without texture coordinates, there is a vertex for each normal. With them, there is one for each
/// normal, pair of texture coordinates and side. Its tangent is the sum over its triangles,
/// weighted by their angles there (as in M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited",
/// 2008). Non-finite coordinates become 0.
RenderVertices render_vertices(const SurfaceMesh& mesh, const CornerNormals& normals);

}  // namespace cascade
