// Triangles laid flat into a plane.
#pragma once

#include "core/vector2.h"
#include "mesh/surface_mesh.h"

#include <array>
#include <cmath>

namespace cascade {

using FlatTriangle = std::array<Vector2d, 3>;

/// A position on a triangle by barycentric weights of its corners, which are ≥ 0 with sum 1.
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

/// Lays a triangle into a plane so that its edge `edge` goes from `from` to `to` and the third
/// corner is to the left of the edge. The distance from `from` to `to` must be the edge's length.
/// Corners keep their indices.
FlatTriangle lay_flat(const SurfaceMesh& mesh, TriangleEdge edge, Vector2d from, Vector2d to);

/// Lays a triangle into a plane with corner 0 at the origin and corner 1 on the x axis. This is the
/// triangle's own frame, in which steps on the surface are given.
FlatTriangle own_frame(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The barycentric weights of a point of the plane. Weights of a point outside are clamped to ≥ 0.
std::array<double, 3> weights_at(const FlatTriangle& flat, Vector2d point);

/// Converts a vector to another frame. `turn` is the x axis of the other frame, a unit vector in
/// the vector's frame.
inline Vector2d turned_into(Vector2d vector, Vector2d turn) {
    return {dot(turn, vector), cross(turn, vector)};
}

/// The end of a walk.
struct WalkEnd {
    SurfacePlace place;
    double part = 1;      ///< The fraction of the step that was walked. Below 1 at a boundary.
    Vector2d turn{1, 0};  ///< The x axis of the final frame, expressed in the initial frame.
};

/// Walks straight across edges by `step`, which is given in the frame of the start's triangle.
/// Stops at a boundary.
WalkEnd walk(const SurfaceMesh& mesh, const SurfacePlace& from, Vector2d step);

}  // namespace cascade
