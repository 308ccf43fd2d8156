// Loop's subdivision, compared with its known limits.
#include "mesh/subdivide.h"

#include "unit/mesh/measures.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

SurfaceMesh subdivided(const SurfaceMesh& mesh, int times) {
    auto made = subdivide(mesh, times);
    EXPECT_TRUE(made) << made.error().message;
    return *std::move(made);
}

TEST(Subdivide, KeepsTheTopologyAndMakesFourOfOne) {
    for (const SurfaceMesh& mesh : {test::box(), test::square(), test::cylinder(8, 3, 1, 2)}) {
        const SurfaceMesh fine = subdivided(mesh, 2);
        test::expect_manifold(fine);
        const MeshFacts before = facts_of(mesh), after = facts_of(fine);
        EXPECT_EQ(after.triangles, 16 * before.triangles);
        EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
        EXPECT_EQ(after.boundaries, before.boundaries);
        EXPECT_EQ(after.components, before.components);
        EXPECT_EQ(after.boundary_edges, 4 * before.boundary_edges);
    }
}

TEST(Subdivide, LeavesARegularPlaneAsItIs) {
    // New positions are means of positions, so the inside of a regular plane does not move.
    const SurfaceMesh plane = test::sheet(12, 12, [](double u, double v) {
        return Vector3d{u, v, 0};
    });
    const SurfaceMesh fine = subdivided(plane, 1);
    for (std::size_t p = 0; p < plane.points.size(); ++p) {
        const Vector3d at = plane.points[p];
        if (at.x < 0.1 || at.x > 0.9 || at.y < 0.1 || at.y > 0.9) continue;
        EXPECT_NEAR(length(fine.points[p] - at), 0, 1e-14);
    }
    for (const Vector3d& p : fine.points) EXPECT_EQ(p.z, 0);
}

TEST(Subdivide, TendsToTheLimitOfAnOctahedron) {
    // A corner with n neighbours tends to (1 − n w) p + w Σ q, w = 1 / (3/(8 b) + n), with
    // b = (5/8 − (3/8 + cos(2π/n)/4)²)/n (C. Loop, 1987): here n = 4, and neighbours cancel.
    const SurfaceMesh octahedron = test::sphere(1);
    ASSERT_EQ(octahedron.points.size(), 6u);
    const double b = (5.0 / 8 - 9.0 / 64) / 4, w = 1 / (3 / (8 * b) + 4);
    const SurfaceMesh fine = subdivided(octahedron, 7);
    for (std::size_t p = 0; p < 6; ++p) {
        EXPECT_NEAR(length(fine.points[p] - octahedron.points[p] * (1 - 4 * w)), 0, 2e-3);
    }
}

TEST(Subdivide, HasNoMostNumberOfNeighbours) {
    // A cone of 200 triangles, whose tip has more neighbours than OpenMesh's table.
    const SurfaceMesh cone = test::sheet(200, 1, [](double u, double v) {
        return test::on_circle(u) * v + Vector3d{0, 0, 1 - v};
    });
    const SurfaceMesh fine = subdivided(cone, 1);
    test::expect_manifold(fine);
    for (const Vector3d& p : fine.points) {
        EXPECT_LE(length(p), 1.01);
        EXPECT_TRUE(is_finite(p));
    }
}

TEST(Subdivide, HalvesTextureAndAttributes) {
    SurfaceMesh plane = test::sheet(6, 6, [](double u, double v) { return Vector3d{u, v, 0}; });
    plane.attributes.push_back({"x", {}});
    for (const Vector3d& p : plane.points) {
        plane.attributes[0].values.push_back(static_cast<float>(p.x));
    }
    // Each triangle has coordinates of its own, so that all edges are seams.
    for (std::size_t t = 0; t < plane.triangles.size(); ++t) {
        auto& corners = plane.texture.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d p = plane.corner(t, k);
            corners[k] = {static_cast<float>(p.x) + static_cast<float>(t), static_cast<float>(p.y)};
        }
    }
    const SurfaceMesh fine = subdivided(plane, 1);
    ASSERT_EQ(fine.texture.size(), fine.triangles.size());
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        const std::size_t old = plane.triangles.size(), parent = t < old ? t : (t - old) / 3;
        double area = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = fine.triangles[t][k];
            const TexturePlace& place = fine.texture[t][k];
            EXPECT_NEAR(place[0] - static_cast<float>(parent), fine.attributes[0].values[p], 1e-5);
            const TexturePlace& b = fine.texture[t][(k + 1) % 3];
            area += static_cast<double>(place[0] * b[1] - b[0] * place[1]) / 2;
        }
        EXPECT_NEAR(area, 1.0 / (6 * 6 * 2 * 4), 1e-4);
    }
}

TEST(Subdivide, RefusesWhatWouldBeTooLarge) {
    const auto made = subdivide(test::sphere(100), 8);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("more than the limit of 16,777,216 triangles"),
              std::string::npos);
}

}  // namespace
}  // namespace cascade
