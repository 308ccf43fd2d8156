#include "surface/point_normals.h"

namespace cascade {

namespace {

/// Of length 1, or `otherwise` where there is no direction.
Vector3d unit_or(Vector3d a, Vector3d otherwise) {
    const Vector3d scaled = unit(a);
    return length(scaled) > 0.5 ? scaled : otherwise;
}

}  // namespace

std::vector<Vector3d> point_normals(const SurfaceMesh& mesh) {
    std::vector<Vector3d> normals(mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vector3d normal = mesh.double_area_normal(t);
        for (const std::uint32_t point : mesh.triangles[t]) {
            normals[point] = normals[point] + normal;
        }
    }
    for (Vector3d& normal : normals) normal = unit_or(normal, {0, 0, 1});
    return normals;
}

Vector3d normal_at(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                   const SurfacePlace& place) {
    const auto& corners = mesh.triangles[place.triangle];
    Vector3d sum;
    for (std::size_t k = 0; k < 3; ++k) sum = sum + normals[corners[k]] * place.weights[k];
    return unit_or(sum, unit_or(mesh.double_area_normal(place.triangle), {0, 0, 1}));
}

}  // namespace cascade
