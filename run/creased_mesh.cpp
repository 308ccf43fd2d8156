#include "run/creased_mesh.h"

#include "surface/disjoint_sets.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr double cosine_of_crease = 0.5;

}  // namespace

DrawnMesh creased_mesh(const SurfaceMesh& surface) {
    const std::size_t count = surface.triangles.size();
    std::vector<Vector3d> normals;
    normals.reserve(count);
    for (std::size_t t = 0; t < count; ++t) normals.push_back(unit(surface.double_area_normal(t)));
    // Corner k of triangle t is number 3 t + k. Those that share a normal are one position.
    DisjointSets corners(3 * count);
    for (std::uint32_t t = 0; t < count; ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = surface.across[t][k];
            if (!other.exists() || other.triangle < t) continue;
            if (dot(normals[t], normals[other.triangle]) < cosine_of_crease) continue;
            corners.join(3 * t + k, 3 * other.triangle + (other.edge + 1) % 3);
            corners.join(3 * t + (k + 1) % 3, 3 * other.triangle + other.edge);
        }
    }
    const MeshFacts facts = facts_of(surface);
    const Vector3d box = facts.high - facts.low;
    DrawnMesh drawn;
    drawn.middle = (facts.low + facts.high) * 0.5;
    drawn.scale = 1 / std::max({box.x, box.y, box.z});
    std::vector<std::uint32_t> positions(3 * count);
    drawn.mesh.triangles.resize(count);
    for (std::uint32_t corner = 0; corner < positions.size(); ++corner) {
        const std::uint32_t first = corners.find(corner);
        if (first == corner) {
            positions[corner] = static_cast<std::uint32_t>(drawn.mesh.positions.size());
            const Vector3d p =
                (surface.corner(corner / 3, corner % 3) - drawn.middle) * drawn.scale;
            drawn.mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y),
                                            static_cast<float>(p.z)});
        }
        drawn.mesh.triangles[corner / 3][corner % 3] = positions[first];
    }
    smooth_normals(drawn.mesh);
    return drawn;
}

}  // namespace cascade
