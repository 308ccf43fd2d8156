// A model for drawing: smooth, except at sharp edges.
#pragma once

#include "mesh/surface_mesh.h"
#include "mesh/triangle_mesh.h"

namespace cascade {

/// The mesh to draw, and its map from space: (p − middle) × scale.
struct DrawnMesh {
    TriangleMesh mesh;  ///< Triangles and corners are numbered as in the surface.
    Vector3d middle;
    double scale = 1;  ///< Makes the longest side of the box 1.
};

/// Normals are averages over the triangles around a point, but not across edges with a bend of more
/// than 60°. Throws std::bad_alloc.
DrawnMesh creased_mesh(const SurfaceMesh& surface);
/// The mesh alone, with the map of another one.
TriangleMesh creased_mesh(const SurfaceMesh& surface, const Vector3d& middle, double scale);

}  // namespace cascade
