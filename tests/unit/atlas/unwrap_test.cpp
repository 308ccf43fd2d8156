// New texture coordinates: charts of shapes with bounded distortion, and difficult surfaces.
#include "mesh/animals.h"
#include "mesh/edge_pairs.h"
#include "mesh/make_mesh.h"
#include "mesh/shapes.h"
#include "tests/support/never.h"
#include "unit/atlas/atlas_checks.h"
#include "unit/atlas/tubes.h"

#include <gmock/gmock.h>

#include <cstring>
#include <functional>
#include <limits>

namespace cascade {
namespace {

using ::testing::HasSubstr;

struct Shape {
    const char* name;
    std::function<Result<SurfaceMesh>()> make;
    std::size_t most_charts;
    double most_mean;
};

class Shapes : public ::testing::TestWithParam<Shape> {};

// The bounds are slightly above the results. A sphere cannot be flat: at best, n equal charts are
// caps of the area 4π/n, and the mean distortion of three caps is above 1.05.
INSTANTIATE_TEST_SUITE_P(
    Unwrap, Shapes,
    ::testing::Values(Shape{"sphere", [] { return sphere_mesh(1, 0.06); }, 6, 1.10},
                      Shape{"torus", [] { return torus_mesh(1, 0.4, 0.06); }, 8, 1.10},
                      Shape{"box",
                            [] {
                                return box_mesh({1, 1, 2}, 0.1);
                            },
                            6, 1.06},
                      Shape{"knot", [] { return knot_mesh(0.4, 0.1); }, 24, 1.10},
                      Shape{"creature", [] { return creature().body.mesh(0.03, test::never); }, 30,
                            1.10}),
    [](const auto& shape) { return std::string(shape.param.name); });

TEST_P(Shapes, LieFlatWithoutOverlaps) {
    SurfaceMesh mesh = *GetParam().make();
    mesh.texture = *test::unwrapped(mesh);
    test::expect_sound(mesh);
    const TextureFacts facts = texture_facts(mesh);
    EXPECT_LE(facts.charts, GetParam().most_charts);
    EXPECT_LE(facts.mean, GetParam().most_mean);
    EXPECT_LE(facts.worst, 4);
    EXPECT_GE(facts.covered, 0.5);
    EXPECT_EQ(facts.shared, 0);
    EXPECT_EQ(facts.mirrored, 0);
    EXPECT_EQ(facts.without_area, 0u);
}

/// All triangles have the same scale, so texels have the same size everywhere.
TEST_P(Shapes, HaveAreasInProportion) {
    SurfaceMesh mesh = *GetParam().make();
    mesh.texture = *test::unwrapped(mesh);
    const double scale = TextureLayout(mesh, 1, 1).covered_area() / mesh.total_area();
    double wrong = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.texture[t];
        const auto along = [](const TexturePlace& p, const TexturePlace& q) {
            return Vector2d{static_cast<double>(q[0] - p[0]), static_cast<double>(q[1] - p[1])};
        };
        const double ratio = cross(along(a, b), along(a, c)) / 2 / (mesh.area(t) * scale);
        if (ratio < 0.5 || ratio > 2) wrong += mesh.area(t);
    }
    EXPECT_LT(wrong, 0.01 * mesh.total_area());
}

TEST_P(Shapes, HaveTheSameBitsWithAnyThreads) {
    const SurfaceMesh mesh = *GetParam().make();
    const MeshTexture one = *test::unwrapped(mesh, 1024, 1);
    for (const int threads : {2, 5}) {
        const MeshTexture other = *test::unwrapped(mesh, 1024, threads);
        ASSERT_EQ(other.size(), one.size());
        EXPECT_EQ(std::memcmp(one.data(), other.data(), sizeof one[0] * one.size()), 0) << threads;
    }
}

TEST_P(Shapes, KeepTheirPadding) {
    SurfaceMesh mesh = *GetParam().make();
    for (const std::int64_t texels : {128, 1024}) {
        mesh.texture = *test::unwrapped(mesh, texels);
        // If there are two empty texels between two charts, the distance of the charts is three
        // steps.
        EXPECT_GE(test::least_gap(mesh, texels, 6), 3) << texels;
    }
}

/// A surface that can be rolled out is not distorted. A closed tube is cut.
TEST(Unwrap, RollsOutTubes) {
    for (const double turn : {0.9, 1.0}) {
        SurfaceMesh mesh = test::tube(turn, 5, 24, 20);
        mesh.texture = *test::unwrapped(mesh);
        const TextureFacts facts = texture_facts(mesh);
        EXPECT_LE(facts.charts, turn < 1 ? 1u : 2u);
        EXPECT_LT(facts.worst, 1.001) << turn;
        test::expect_sound(mesh);
    }
}

/// A chart of the whole ribbon would leave most of the texture empty.
TEST(Unwrap, CutsRibbonsToLength) {
    SurfaceMesh mesh = test::tube(0.9, 0.05, 200, 2);
    mesh.texture = *test::unwrapped(mesh);
    test::expect_sound(mesh);
    EXPECT_GT(texture_facts(mesh).covered, 0.3);
}

// Coordinates are found for models of any size and position.
TEST(Unwrap, KnowsNoUnits) {
    for (const double scale : {1e-60, 1e60}) {
        SurfaceMesh mesh = *sphere_mesh(1, 0.3);
        for (Vector3d& p : mesh.points) p = p * scale;
        mesh.texture = *test::unwrapped(mesh);
        test::expect_sound(mesh);
    }
    SurfaceMesh far_away = *sphere_mesh(1, 0.3);
    for (Vector3d& p : far_away.points) p = p + Vector3d{1e8, 0, 0};
    far_away.texture = *test::unwrapped(far_away);
    test::expect_sound(far_away);
}

/// Triangles without area, needles, and points at which any number of triangles meet.
TEST(Unwrap, TakesDegenerateTriangles) {
    SurfaceMesh mesh = *sphere_mesh(1, 0.2);
    for (std::size_t p = 0; p < mesh.points.size(); p += 3) {
        mesh.points[p] = mesh.points[p == 0 ? 1 : p - 1];
    }
    mesh.texture = *test::unwrapped(mesh);
    EXPECT_EQ(TextureLayout(mesh, 64, 64).skipped().without_place, 0u);

    mesh = *box_mesh({1, 1, 1}, 0.2);
    for (Vector3d& p : mesh.points) p.z *= 1e-9;  // A flat body with two sides.
    mesh.texture = *test::unwrapped(mesh);
    test::expect_sound(mesh);

    SurfaceMesh cone = mesh_of({{0, 0, 50}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                               {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
    cone.texture = *test::unwrapped(cone);
    test::expect_sound(cone);
}

/// A surface of noise bends everywhere.
TEST(Unwrap, TakesNoise) {
    SurfaceMesh mesh = *sphere_mesh(1, 0.1);
    std::uint32_t state = 1;
    for (Vector3d& p : mesh.points) {
        state = state * 1664525 + 1013904223;
        p = p * (1 + 0.4 * (static_cast<double>(state >> 8) / (1 << 24)));
    }
    mesh.texture = *test::unwrapped(mesh);
    test::expect_sound(mesh);
}

SurfaceMesh separate_triangles(std::uint32_t count) {
    std::vector<Vector3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t k = 0; k < count; ++k) {
        const double x = 2.0 * k;
        points.insert(points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
        triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh_of(points, triangles);
}

TEST(Unwrap, PacksManyParts) {
    SurfaceMesh mesh = separate_triangles(3000);
    mesh.texture = *test::unwrapped(mesh, 2048);
    test::expect_sound(mesh);
    EXPECT_EQ(texture_facts(mesh).charts, 3000u);
    EXPECT_GE(test::least_gap(mesh, 2048, 4), 3);
}

TEST(Unwrap, RefusesMorePartsThanFit) {
    const auto made = test::unwrapped(separate_triangles(3000), 32);
    ASSERT_FALSE(made);
    EXPECT_THAT(made.error().message,
                HasSubstr("the model consists of 3,000 separate parts, too many for a texture of "
                          "32 × 32"));
    EXPECT_TRUE(test::unwrapped(separate_triangles(3000), 256));
}

TEST(Unwrap, EndsWhenItIsCancelled) {
    Team team(2);
    const std::atomic<bool> cancel = true;
    EXPECT_TRUE(unwrap(*sphere_mesh(1, 0.1), 1024, team, cancel));
}

}  // namespace
}  // namespace cascade
