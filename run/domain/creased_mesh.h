// A model as it is drawn: round where it is meant to be round, with edges where it has edges.
#pragma once

#include "mesh/surface_mesh.h"
#include "render/triangle_mesh.h"

namespace cascade {

/// What a surface is drawn as, and how it got there from space: (p − middle) × scale.
struct DrawnMesh {
    TriangleMesh mesh;  ///< Triangles have the numbers and corners of the surface's.
    Vector3d middle;
    double scale = 1;  ///< Makes the longest side of its box 1.
};

/// Normals are averages over the triangles around a point, but not across edges at which these meet
/// at more than 60°. Throws std::bad_alloc.
DrawnMesh creased_mesh(const SurfaceMesh& surface);

}  // namespace cascade
