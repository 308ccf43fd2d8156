// Triangles laid flat: in a plane, as large as in space.
#pragma once

#include "core/vector2.h"
#include "mesh/surface_mesh.h"

#include <array>
#include <cmath>

namespace cascade {

using FlatTriangle = std::array<Vector2d, 3>;

/// A point of a triangle as weights of its corners; they are not negative and their sum is 1.
struct SurfacePlace {
    std::uint32_t triangle = 0;
    std::array<double, 3> weights{1, 0, 0};
};

inline Vector3d position_of(const SurfaceMesh& mesh, const SurfacePlace& place) {
    return mesh.corner(place.triangle, 0) * place.weights[0] +
           mesh.corner(place.triangle, 1) * place.weights[1] +
           mesh.corner(place.triangle, 2) * place.weights[2];
}

inline Vector2d position_of(const FlatTriangle& flat, const std::array<double, 3>& weights) {
    return flat[0] * weights[0] + flat[1] * weights[1] + flat[2] * weights[2];
}

/// The triangle in a plane, its edge `edge` from `from` to `to`, which are as far apart as in
/// space; the third corner lies to the left of the edge. Corners keep their numbers.
FlatTriangle lay_flat(const SurfaceMesh& mesh, TriangleEdge edge, Vector2d from, Vector2d to);

/// The same with corner 0 at the origin and corner 1 on the x axis: the frame of the triangle in
/// which steps on the surface are given.
FlatTriangle own_frame(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The weights that make up a point of the plane. Those of a point outside are brought to the
/// nearest that are allowed: below 0 becomes 0.
std::array<double, 3> weights_at(const FlatTriangle& flat, Vector2d point);

/// A vector in another frame, whose x axis is `turn` (of length 1) in the first one.
inline Vector2d turned_into(Vector2d vector, Vector2d turn) {
    return {dot(turn, vector), cross(turn, vector)};
}

/// Where a walk ended.
struct WalkEnd {
    SurfacePlace place;
    double part = 1;      ///< Of the step that was walked; below 1 at a boundary.
    Vector2d turn{1, 0};  ///< The x axis of the frame in which it ended, in that in which it began.
};

/// Goes straight on from a place by a step in the frame of its triangle, unfolding triangles on the
/// way; ends early at a boundary.
WalkEnd walk(const SurfaceMesh& mesh, const SurfacePlace& from, Vector2d step);

}  // namespace cascade
