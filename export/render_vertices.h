// Vertices as renderers want them: each with one normal and one place in the texture, so that
// points on creases and along the seams of the texture become several vertices.
#pragma once

#include "mesh/normals.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// What a normal map is relative to: the direction in which the first texture coordinate grows, at
/// right angles to the smooth normal and of length 1, and whether the second one grows to the left
/// of it (1) or to the right (−1, where the texture is mirrored), seen from outside.
struct Tangent {
    Vector3d direction;
    int side = 1;
};

struct RenderVertices {
    std::vector<std::uint32_t> points;  ///< Of the mesh, in ascending order, each at least once.
    std::vector<Vector3d> normals;      ///< One per vertex, of length 1.
    std::vector<TexturePlace> texture;  ///< Finite; empty where the mesh has none.
    std::vector<Tangent> tangents;      ///< Likewise.
    /// Those of the mesh in their order, over the vertices.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Without texture coordinates there is a vertex for each normal. With them there is one for each
/// normal, place in the texture and side; its tangent is the sum over its triangles, each weighted
/// by its angle there (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, does the
/// same). Coordinates that are not finite become 0.
RenderVertices render_vertices(const SurfaceMesh& mesh, const CornerNormals& normals);

}  // namespace cascade
