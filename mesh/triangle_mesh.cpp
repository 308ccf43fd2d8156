// The normal of a vertex is the sum of its triangles' normals, weighted by area: the cross product
// of two edges contains the triangle's area.
#include "mesh/triangle_mesh.h"

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

void append(const TriangleMesh& added, TriangleMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    if (!added.shades.empty() || !mesh.shades.empty()) {
        mesh.shades.resize(mesh.positions.size(), 1);
        mesh.shades.insert(mesh.shades.end(), added.shades.begin(), added.shades.end());
    }
    mesh.positions.insert(mesh.positions.end(), added.positions.begin(), added.positions.end());
    mesh.normals.insert(mesh.normals.end(), added.normals.begin(), added.normals.end());
    if (!mesh.shades.empty()) mesh.shades.resize(mesh.positions.size(), 1);
    for (const auto& [a, b, c] : added.triangles) {
        mesh.triangles.push_back({first + a, first + b, first + c});
    }
}

void Box::add(Vector3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

Box bounds(const TriangleMesh& mesh) {
    CHECK(!mesh.positions.empty(), "a mesh has positions");
    Box box{mesh.positions[0], mesh.positions[0]};
    for (const Vector3& p : mesh.positions) box.add(p);
    return box;
}

}  // namespace cascade
