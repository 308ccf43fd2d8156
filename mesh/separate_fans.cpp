// Joins, in disjoint sets, the corners at one point of triangles that share an edge. Each set is a
// fan.
#include "mesh/separate_fans.h"

#include "mesh/disjoint_sets.h"
#include "mesh/sort_by_point.h"

#include <algorithm>
#include <utility>

namespace cascade {

std::vector<std::uint32_t> separate_fans(SurfaceMesh& mesh) {
    const auto corners = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    DisjointSets fans(corners);
    const auto number = [](std::uint32_t t, std::uint32_t k) { return 3 * t + k % 3; };
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) continue;
            fans.join(number(t, k), number(other.triangle, other.edge + 1));
            fans.join(number(t, k + 1), number(other.triangle, other.edge));
        }
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> owners;  // A point and one of its fans.
    for (std::uint32_t c = 0; c < corners; ++c) {
        if (fans.find(c) == c) owners.emplace_back(mesh.triangles[c / 3][c % 3], c);
    }
    // Computed from the triangles, because the mesh's points may be elsewhere.
    std::size_t points = 0;
    for (const auto& owner : owners)
        points = std::max<std::size_t>(points, owner.first + std::size_t{1});
    sort_by_point(owners, points, [](const auto& owner) { return owner.first; });
    std::vector<std::uint32_t> point_of_fan(corners);
    std::vector<std::uint32_t> sources;
    sources.reserve(owners.size());
    for (const auto& [point, fan] : owners) {
        point_of_fan[fan] = static_cast<std::uint32_t>(sources.size());
        sources.push_back(point);
    }
    for (std::uint32_t c = 0; c < corners; ++c) {
        mesh.triangles[c / 3][c % 3] = point_of_fan[fans.find(c)];
    }
    return sources;
}

}  // namespace cascade
