// Checks for all surfaces that were tiled anew.
#pragma once

#include "surface/retile.h"
#include "unit/surface/even_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::test {

/// A torus of n × m quadrilaterals.
inline PolygonSoup torus_soup(std::uint32_t n, std::uint32_t m) {
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < m; ++j) {
            const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
            const double r = 1 + 0.4 * std::cos(v);
            soup.points.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
            for (const std::uint32_t corner :
                 {i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m,
                  i * m + (j + 1) % m}) {
                soup.corners.push_back(corner);
            }
            soup.ends.push_back(soup.corners.size());
        }
    }
    return soup;
}

/// Expects that the triangles at each point form a single fan.
inline void expect_one_fan_each(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> triangles(mesh.points.size()), any(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t point : mesh.triangles[t]) {
            ++triangles[point];
            any[point] = t;
        }
    }
    for (std::uint32_t point = 0; point < mesh.points.size(); ++point) {
        const auto corner_in = [&](std::uint32_t t) {
            return static_cast<std::uint32_t>(
                std::find(mesh.triangles[t].begin(), mesh.triangles[t].end(), point) -
                mesh.triangles[t].begin());
        };
        std::uint32_t found = 1;
        bool is_closed = false;
        for (const std::uint32_t side : {2u, 0u}) {
            std::uint32_t t = any[point];
            for (;;) {
                const TriangleEdge other = mesh.across[t][(corner_in(t) + side) % 3];
                is_closed = other.exists() && other.triangle == any[point];
                if (!other.exists() || is_closed) break;
                t = other.triangle;
                ++found;
            }
            if (is_closed) break;
        }
        EXPECT_EQ(found, triangles[point]) << "point " << point;
    }
}

/// Expects that the new surface has the topology of the old one.
inline void expect_same_topology(const SurfaceMesh& old, const Retiled& retiled,
                                 std::size_t places) {
    expect_manifold(retiled.mesh);
    expect_one_fan_each(retiled.mesh);
    const MeshFacts before = facts_of(old), behind = facts_of(retiled.mesh);
    EXPECT_EQ(behind.points, places + retiled.kept.size());
    EXPECT_EQ(behind.euler_characteristic, before.euler_characteristic);
    EXPECT_EQ(behind.components, before.components);
    EXPECT_EQ(behind.boundaries, before.boundaries);
    for (std::size_t k = 0; k < retiled.kept.size(); ++k) {
        EXPECT_EQ(retiled.mesh.points[places + k], old.points[retiled.kept[k].old_point]);
    }
    for (const auto& [a, b, c] : retiled.mesh.triangles) EXPECT_TRUE(a != b && b != c && c != a);
}

/// The largest distance of a new point from its place.
inline double farthest_moved(const SurfaceMesh& old, const std::vector<SurfacePlace>& places,
                             const Retiled& retiled) {
    double farthest = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        farthest = std::max(farthest, length(retiled.mesh.points[k] - position_of(old, places[k])));
    }
    return farthest;
}

}  // namespace cascade::test
