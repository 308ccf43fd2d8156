// Moves the model to the origin and scales its longest side to 1, both before numbers are rounded
// to binary32.
#include "run/domain/creased_mesh.h"

#include "mesh/normals.h"

#include <algorithm>
#include <utility>

namespace cascade {

TriangleMesh creased_mesh(const SurfaceMesh& surface, const Vector3d& middle, double scale) {
    CornerNormals corners = corner_normals(surface);
    TriangleMesh mesh;
    // A point gets a separate vertex for each of its different normals.
    mesh.positions.reserve(corners.points.size());
    mesh.normals.reserve(corners.points.size());
    for (std::size_t k = 0; k < corners.points.size(); ++k) {
        mesh.positions.push_back(single((surface.points[corners.points[k]] - middle) * scale));
        mesh.normals.push_back(single(corners.normals[k]));
    }
    mesh.triangles = std::move(corners.numbers);
    return mesh;
}

DrawnMesh creased_mesh(const SurfaceMesh& surface) {
    const MeshFacts facts = facts_of(surface);
    const Vector3d box = facts.high - facts.low;
    DrawnMesh drawn;
    drawn.middle = (facts.low + facts.high) * 0.5;
    drawn.scale = 1 / std::max({box.x, box.y, box.z});
    drawn.mesh = creased_mesh(surface, drawn.middle, drawn.scale);
    return drawn;
}

}  // namespace cascade
