// A vertex normal is the sum of its triangles' cross products, which weights them by area.
#include "render/triangle_mesh.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {

void smooth_normals(TriangleMesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), {});
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vector3 origin = mesh.positions[a];
        const Vector3 normal = cross(mesh.positions[b] - origin, mesh.positions[c] - origin);
        for (const std::uint32_t corner : {a, b, c}) {
            mesh.normals[corner] = mesh.normals[corner] + normal;
        }
    }
    for (Vector3& normal : mesh.normals) normal = unit(normal);
}

Box bounds(const TriangleMesh& mesh) {
    CHECK(!mesh.positions.empty(), "a mesh has positions");
    Box box{mesh.positions[0], mesh.positions[0]};
    for (const Vector3& p : mesh.positions) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                    std::max(box.high.z, p.z)};
    }
    return box;
}

}  // namespace cascade
