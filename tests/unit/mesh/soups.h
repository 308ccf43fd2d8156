// Small models for tests, written as polygons over points.
#pragma once

#include "mesh/make_mesh.h"
#include "mesh/separate_fans.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

namespace cascade::test {

inline PolygonSoup soup_of(std::vector<Vector3d> points,
                           std::initializer_list<std::vector<std::uint32_t>> polygons) {
    PolygonSoup soup;
    soup.points = std::move(points);
    for (const auto& polygon : polygons) {
        for (const std::uint32_t corner : polygon) soup.corners.push_back(corner);
        soup.ends.push_back(soup.corners.size());
    }
    return soup;
}

/// The cube 0..1³, with six squares that are counterclockwise seen from outside.
inline PolygonSoup cube() {
    return soup_of(
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// Adds the polygons of another soup, moved by `by`.
inline void append(PolygonSoup& soup, const PolygonSoup& other, Vector3d by = {}) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (const Vector3d& p : other.points) soup.points.push_back(p + by);
    const std::size_t corners = soup.corners.size();
    for (const std::uint32_t corner : other.corners) soup.corners.push_back(first + corner);
    for (const std::size_t end : other.ends) soup.ends.push_back(corners + end);
}

/// Expects that neighbours are mutual, that they share an edge in opposite directions, and that
/// there is one fan of triangles around each point.
inline void expect_manifold(const SurfaceMesh& mesh) {
    ASSERT_EQ(mesh.across.size(), mesh.triangles.size());
    std::vector<bool> is_used(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            is_used.at(mesh.triangles[t][k]) = true;
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) continue;
            const TriangleEdge here{t, k};
            ASSERT_EQ(mesh.across.at(other.triangle).at(other.edge), here);
            EXPECT_EQ(mesh.triangles[other.triangle][other.edge], mesh.triangles[t][(k + 1) % 3]);
            EXPECT_EQ(mesh.triangles[other.triangle][(other.edge + 1) % 3], mesh.triangles[t][k]);
        }
    }
    for (std::size_t k = 0; k < is_used.size(); ++k) EXPECT_TRUE(is_used[k]) << "point " << k;
    SurfaceMesh separated = mesh;
    EXPECT_EQ(separate_fans(separated).size(), mesh.points.size());
}

/// The volume inside a closed surface.
inline double volume_of(const SurfaceMesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        sum += dot(mesh.corner(t, 0), cross(mesh.corner(t, 1), mesh.corner(t, 2))) / 6;
    }
    return sum;
}

}  // namespace cascade::test
