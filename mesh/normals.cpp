// Groups corners that are connected across edges without a crease, and gives each group one normal.
#include "mesh/normals.h"

#include "mesh/disjoint_sets.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

constexpr double cosine_of_crease = 0.5;

/// `a` scaled to length 1, or `otherwise` if a is 0.
Vector3d unit_or(Vector3d a, Vector3d otherwise) {
    const Vector3d scaled = unit(a);
    return length(scaled) > 0.5 ? scaled : otherwise;
}

/// Joins the corners at each point that no crease separates. Corner k of triangle t has the index 3
/// t + k.
DisjointSets smooth_groups(const SurfaceMesh& mesh) {
    std::vector<Vector3d> normals;
    normals.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        normals.push_back(unit(mesh.double_area_normal(t)));
    }
    DisjointSets groups(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists() || other.triangle < t) continue;
            if (dot(normals[t], normals[other.triangle]) < cosine_of_crease) continue;
            groups.join(3 * t + k, 3 * other.triangle + (other.edge + 1) % 3);
            groups.join(3 * t + (k + 1) % 3, 3 * other.triangle + other.edge);
        }
    }
    return groups;
}

}  // namespace

std::vector<Vector3d> point_normals(const SurfaceMesh& mesh) {
    std::vector<Vector3d> normals(mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vector3d normal = mesh.double_area_normal(t);
        for (const std::uint32_t point : mesh.triangles[t])
            normals[point] = normals[point] + normal;
    }
    for (Vector3d& normal : normals) normal = unit_or(normal, {0, 0, 1});
    return normals;
}

Vector3d normal_at(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                   const SurfacePlace& place) {
    Vector3d sum;
    for (std::size_t k = 0; k < 3; ++k) {
        sum = sum + normals[mesh.triangles[place.triangle][k]] * place.weights[k];
    }
    const Vector3d scaled = unit(sum);
    if (length(scaled) > 0.5) return scaled;
    return unit_or(mesh.double_area_normal(place.triangle), {0, 0, 1});
}

CornerNormals corner_normals(const SurfaceMesh& mesh) {
    DisjointSets groups = smooth_groups(mesh);
    const auto count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> firsts;  // A point and one of its groups.
    for (std::uint32_t corner = 0; corner < count; ++corner) {
        if (groups.find(corner) != corner) continue;
        firsts.emplace_back(mesh.triangles[corner / 3][corner % 3], corner);
    }
    std::sort(firsts.begin(), firsts.end());
    CornerNormals result;
    std::vector<std::uint32_t> number_of_group(count);
    for (std::uint32_t number = 0; number < firsts.size(); ++number) {
        number_of_group[firsts[number].second] = number;
        result.points.push_back(firsts[number].first);
    }
    result.normals.resize(firsts.size());
    result.numbers.resize(mesh.triangles.size());
    for (std::uint32_t corner = 0; corner < count; ++corner) {
        const std::uint32_t number = number_of_group[groups.find(corner)];
        result.numbers[corner / 3][corner % 3] = number;
        result.normals[number] = result.normals[number] + mesh.double_area_normal(corner / 3);
    }
    for (Vector3d& normal : result.normals) normal = unit_or(normal, {0, 0, 1});
    return result;
}

Vector3d CornerNormals::at(const SurfaceMesh& mesh, const SurfacePlace& place) const {
    Vector3d sum;
    for (std::size_t k = 0; k < 3; ++k) {
        sum = sum + normals[numbers[place.triangle][k]] * place.weights[k];
    }
    return unit_or(sum, unit_or(mesh.double_area_normal(place.triangle), {0, 0, 1}));
}

}  // namespace cascade
