// Prepares a model for drawing, with normals that are smooth except across sharp edges.
#pragma once

#include "mesh/surface_mesh.h"
#include "mesh/triangle_mesh.h"

namespace cascade {

/// A mesh to be drawn. A position p on the model becomes (p − middle) × scale.
struct DrawnMesh {
    /// The triangles and their corners have the same numbers as in the surface of the model.
    TriangleMesh mesh;
    Vector3d middle;
    double scale = 1;  ///< Chosen so that the longest side of the bounding box becomes 1.
};

/// Makes the mesh of a surface. A normal is the average over the triangles around a point, except
/// across edges with an angle of more than 60°. Throws std::bad_alloc.
DrawnMesh creased_mesh(const SurfaceMesh& surface);
/// Makes the mesh with this middle and scale, for example with the middle and scale of another
/// surface.
TriangleMesh creased_mesh(const SurfaceMesh& surface, const Vector3d& middle, double scale);

}  // namespace cascade
