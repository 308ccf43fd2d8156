// Vertices for renderers, with one normal and one pair of texture coordinates each. Points on
// creases and texture seams become several vertices.
#pragma once

#include "mesh/normals.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// The frame of a normal map at a vertex. Its vector has length 1, is perpendicular to the smooth
/// normal, and points in the direction in which the first texture coordinate grows. Its sign says
/// whether the second coordinate grows to the left of this vector (1), or to the right (−1, if the
/// texture is mirrored), seen from outside.
struct Tangent {
    Vector3d direction;
    int side = 1;
};

struct RenderVertices {
    /// The point of the mesh to which each vertex belongs, in ascending order. Each point occurs at
    /// least once.
    std::vector<std::uint32_t> points;
    std::vector<Vector3d> normals;  ///< One per vertex, of length 1.
    /// Finite numbers. Empty if the mesh has no texture coordinates.
    std::vector<TexturePlace> texture;
    /// One tangent per vertex. Empty if the mesh has no texture coordinates.
    std::vector<Tangent> tangents;
    /// The corners of the mesh's triangles, as indices of vertices, in the order of the mesh.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Makes vertices from the corners of a mesh. Without texture coordinates, a point has one vertex
/// for each normal. With them, it has one for each combination of normal, texture coordinates and
/// side. The tangent of a vertex is the mean of its triangles' tangents, weighted by their angles
/// at the vertex (as in M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008). Texture
/// coordinates that are not finite become 0.
RenderVertices render_vertices(const SurfaceMesh& mesh, const CornerNormals& normals);

}  // namespace cascade
