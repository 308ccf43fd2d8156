// Facts of triangle meshes whose positions are repeated where normals differ.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>
#include <map>
#include <set>
#include <utility>

namespace cascade::test {

/// Whether every edge occurs exactly once in each direction.
inline bool is_closed(const TriangleMesh& mesh) {
    using Place = std::array<float, 3>;
    std::multiset<std::pair<Place, Place>> edges;
    const auto place = [&](std::uint32_t number) {
        const Vector3& p = mesh.positions[number];
        return Place{p.x, p.y, p.z};
    };
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.emplace(place(triangle[k]), place(triangle[(k + 1) % 3]));
        }
    }
    for (const auto& [from, to] : edges) {
        if (from == to || edges.count({from, to}) != 1 || edges.count({to, from}) != 1)
            return false;
    }
    return !edges.empty();
}

/// The enclosed volume. It is positive if the triangles face outwards.
inline double volume_of(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        sum += static_cast<double>(
            dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c])));
    }
    return sum / 6;
}

}  // namespace cascade::test
