// Converts between directions in space and in a triangle's plane.
#pragma once

#include "mesh/flat.h"

namespace cascade {

/// Three perpendicular unit vectors: the axes of a triangle's own frame (mesh/flat.h) and its
/// outward normal. For a triangle without area they are any three such vectors, the first along its
/// longest edge.
struct TangentFrame {
    Vector3d along;   ///< The x axis: from corner 0 to corner 1.
    Vector3d across;  ///< The y axis, to the left of `along`.
    Vector3d normal;

    Vector3d in_space(Vector2d v) const { return along * v.x + across * v.y; }
    /// The projection of a vector into the plane.
    Vector2d in_plane(Vector3d v) const { return {dot(along, v), dot(across, v)}; }
};

TangentFrame tangent_frame(const SurfaceMesh& mesh, std::uint32_t triangle);

}  // namespace cascade
