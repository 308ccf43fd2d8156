// Simplified surfaces keep their topology, their shape and the edges of their pattern.
#include "mesh/simplify.h"

#include "mesh/flat.h"
#include "mesh/shapes.h"
#include "tests/support/never.h"
#include "unit/mesh/measures.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cascade {
namespace {

using test::never;

Simplified simplified(const SurfaceMesh& mesh, std::size_t triangles,
                      const KeptPattern& pattern = {}) {
    auto made = simplify(mesh, triangles, pattern, never);
    EXPECT_TRUE(made) << made.error().message;
    return *std::move(made);
}

TEST(Simplify, KeepsAClosedSurface) {
    const SurfaceMesh fine = test::sphere(40);
    for (const std::size_t triangles : {3000u, 500u, 60u}) {
        const Simplified coarse = simplified(fine, triangles);
        test::expect_closed(coarse.mesh);
        EXPECT_EQ(facts_of(coarse.mesh).euler_characteristic, 2);
        EXPECT_LE(coarse.mesh.triangles.size(), triangles);
        EXPECT_GE(coarse.mesh.triangles.size(), triangles - 1);
        // The points are on the sphere, so a uniform mesh of equilateral triangles has this
        // sagitta.
        const double side =
            std::sqrt(4 * std::numbers::pi / static_cast<double>(triangles) * 4 / std::sqrt(3.0));
        for (std::size_t t = 0; t < coarse.mesh.triangles.size(); ++t) {
            const Vector3d middle = position_of(coarse.mesh, {static_cast<std::uint32_t>(t),
                                                              {1.0 / 3, 1.0 / 3, 1.0 / 3}});
            EXPECT_GT(length(middle), 1 - 0.5 * side * side);
        }
        EXPECT_GT(test::smallest_angle(coarse.mesh), 8);
    }
}

TEST(Simplify, StopsWhereTheTopologyNeedsItsTriangles) {
    const SurfaceMesh torus = test::torus(40, 20, 1, 0.4);
    const Simplified coarse = simplified(torus, 1);
    test::expect_closed(coarse.mesh);
    EXPECT_EQ(facts_of(coarse.mesh).euler_characteristic, 0);
    EXPECT_GE(coarse.mesh.triangles.size(), 14u) << "no torus has fewer";
    EXPECT_LT(coarse.mesh.triangles.size(), 200u);
}

TEST(Simplify, LosesNothingOfAPlane) {
    const SurfaceMesh square = test::sheet(30, 30, [](double u, double v) {
        return Vector3d{u, v, 0};
    });
    const Simplified coarse = simplified(square, 40);
    test::expect_manifold(coarse.mesh);
    EXPECT_LE(coarse.mesh.triangles.size(), 40u);
    EXPECT_NEAR(coarse.mesh.total_area(), 1, 1e-12) << "corners of the boundary stay";
    EXPECT_EQ(facts_of(coarse.mesh).boundaries, 1u);
}

TEST(Simplify, KeepsEdgesOfTheCube) {
    const SurfaceMesh cube = *box_mesh({1, 1, 1}, 0.1);
    const Simplified coarse = simplified(cube, 12);
    EXPECT_EQ(coarse.mesh.triangles.size(), 12u);
    EXPECT_NEAR(coarse.mesh.total_area(), 6, 1e-12);
}

TEST(Simplify, FollowsThePattern) {
    // A disc of another colour on a square: more points remain along the disc's edge, and its area,
    // found from the colours of corners, hardly changes.
    const SurfaceMesh square = test::sheet(60, 60, [](double u, double v) {
        return Vector3d{u, v, 0};
    });
    std::vector<std::array<float, 3>> colours;
    for (const Vector3d& p : square.points) {
        const double r = length(p - Vector3d{0.5, 0.5, 0});
        const float part = std::clamp(static_cast<float>((0.3 - r) / 0.03 + 0.5), 0.0F, 1.0F);
        colours.push_back({part, part, part});
    }
    const auto covered = [&](const Simplified& s) {
        double sum = 0;
        for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t) {
            for (const std::uint32_t p : s.mesh.triangles[t]) {
                sum += s.mesh.area(t) / 3 * static_cast<double>(colours[s.points[p]][0]);
            }
        }
        return sum;
    };
    const double disc = std::numbers::pi * 0.09;
    const Simplified with = simplified(square, 300, {colours, 0.05});
    const Simplified without = simplified(square, 300);
    EXPECT_NEAR(covered(with), disc, 0.02 * disc);
    std::size_t near_with = 0, near_without = 0;
    const auto count = [](const SurfaceMesh& mesh) {
        return static_cast<std::size_t>(
            std::count_if(mesh.points.begin(), mesh.points.end(), [](const Vector3d& p) {
                return std::abs(length(p - Vector3d{0.5, 0.5, 0}) - 0.3) < 0.04;
            }));
    };
    near_with = count(with.mesh);
    near_without = count(without.mesh);
    EXPECT_GT(near_with, 2 * near_without);
    EXPECT_NEAR(with.mesh.total_area(), 1, 1e-9);
}

TEST(Simplify, KeepsAttributesAndSaysWhichPointsAreLeft) {
    SurfaceMesh fine = test::sphere(10);
    fine.attributes.push_back({"x", {}});
    for (const Vector3d& p : fine.points) {
        fine.attributes[0].values.push_back(static_cast<float>(p.x));
    }
    const Simplified coarse = simplified(fine, 100);
    ASSERT_EQ(coarse.points.size(), coarse.mesh.points.size());
    for (std::size_t p = 0; p < coarse.points.size(); ++p) {
        EXPECT_EQ(coarse.mesh.points[p], fine.points[coarse.points[p]]);
        EXPECT_EQ(coarse.mesh.attributes.at(0).values[p],
                  fine.attributes[0].values[coarse.points[p]]);
        EXPECT_EQ(coarse.merged[coarse.points[p]], p);
    }
    // Merged points are close to each other.
    ASSERT_EQ(coarse.merged.size(), fine.points.size());
    for (std::size_t p = 0; p < fine.points.size(); ++p) {
        EXPECT_LT(length(fine.points[p] - coarse.mesh.points.at(coarse.merged[p])), 0.6);
    }
}

TEST(Simplify, WorksAtAllScales) {
    const SurfaceMesh unit_sphere = test::sphere(20);
    const Simplified expected = simplified(unit_sphere, 200);
    for (const double scale : {0x1p-200, 0x1p200}) {
        SurfaceMesh scaled = unit_sphere;
        for (Vector3d& p : scaled.points) p = p * scale;
        EXPECT_EQ(simplified(scaled, 200).mesh.triangles, expected.mesh.triangles);
    }
}

TEST(Simplify, EndsWhenCancelled) {
    const std::atomic<bool> cancel{true};
    const auto made = simplify(test::sphere(40), 10, {}, cancel);
    ASSERT_TRUE(made);
    EXPECT_GT(made->mesh.triangles.size(), 10000u);
}

}  // namespace
}  // namespace cascade
