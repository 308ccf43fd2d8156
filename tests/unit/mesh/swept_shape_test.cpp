// Swept shapes that are spheres, cones and tori.
#include "mesh/swept_shape.h"
#include "unit/mesh/closed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace cascade {
namespace {

using std::numbers::pi;

SweptSurface sphere() {
    return [](double t, double s) {
        const double across = std::sin(pi * t), around = 2 * pi * s;
        return Vector3d{across * std::cos(around), -std::cos(pi * t), across * std::sin(around)};
    };
}

/// A cone with radius 1 at the root and height 1.
SweptSurface cone() {
    return surface_of({[](double t, double) { return 1 - t; },
                       [](double t) {
                           return Vector3d{0, t, 0};
                       }});
}

TEST(SweptShape, ASpheresVolumeIsOfSecondOrder) {
    double before = 0;
    for (const std::uint32_t count : {16u, 32u, 64u}) {
        const Result<TriangleMesh> mesh = swept_shape(sphere(), {count, 2 * count});
        ASSERT_TRUE(mesh);
        EXPECT_TRUE(test::is_closed(*mesh));
        const double missing = 4 * pi / 3 - test::volume_of(*mesh);
        EXPECT_GT(missing, 0);
        if (before > 0) {
            EXPECT_NEAR(before / missing, 4, 0.1);
        }
        before = missing;
    }
    EXPECT_LT(before, 0.01);
}

TEST(SweptShape, NormalsAreThoseOfTheSurface) {
    const Result<TriangleMesh> mesh = swept_shape(sphere(), {20, 30});
    ASSERT_TRUE(mesh);
    for (std::size_t k = 0; k < mesh->positions.size(); ++k) {
        const bool is_pole = std::abs(mesh->positions[k].y) > 0.999F;
        EXPECT_LT(length(mesh->normals[k] - mesh->positions[k]), is_pole ? 1e-3F : 1e-5F);
    }
}

TEST(SweptShape, ConesHaveACapAndASharpTip) {
    const Result<TriangleMesh> mesh = swept_shape(cone(), {4, 24});
    ASSERT_TRUE(mesh);
    EXPECT_TRUE(test::is_closed(*mesh));
    // A pyramid over a regular polygon.
    EXPECT_NEAR(test::volume_of(*mesh), 24.0 / 2 * std::sin(2 * pi / 24) / 3, 1e-6);
    int down = 0;
    for (std::size_t k = 0; k < mesh->positions.size(); ++k) {
        if (mesh->normals[k].y < -0.999F) {
            EXPECT_EQ(mesh->positions[k].y, 0);
            ++down;
        } else {
            EXPECT_NEAR(mesh->normals[k].y, std::sqrt(0.5), 1e-3);
        }
    }
    EXPECT_EQ(down, 25);
}

TEST(SweptShape, FacesOutwardsWhicheverWaySRuns) {
    const SweptSurface there = cone();
    const SweptSurface back = [&](double t, double s) { return there(t, 1 - s); };
    EXPECT_NEAR(test::volume_of(*swept_shape(back, {4, 24})),
                test::volume_of(*swept_shape(there, {4, 24})), 1e-6);
}

TEST(SweptShape, TubesFollowABentLine) {
    // Half a torus: its volume is that of a straight tube (Pappus).
    const SweptSurface bow =
        surface_of({[](double, double) { return 0.2; },
                    [](double t) {
                        return Vector3d{0, std::sin(pi * t), -std::cos(pi * t)};
                    }});
    const Result<TriangleMesh> mesh = swept_shape(bow, {200, 100});
    ASSERT_TRUE(mesh);
    EXPECT_TRUE(test::is_closed(*mesh));
    EXPECT_NEAR(test::volume_of(*mesh), pi * 0.04 * pi, 1e-3);
    // s = 0 is in the direction of x. Where the line goes upwards, s = 1/4 is in the direction of
    // z.
    EXPECT_LT(length(bow(0, 0) - Vector3d{0.2, 0, -1}), 1e-9);
    EXPECT_LT(length(bow(0, 0.25) - Vector3d{0, 0, -0.8}), 1e-5);
}

TEST(SweptShape, MeshesKeepToTheirDetail) {
    for (const SweptDetail detail : {SweptDetail{0.3, 1}, {10, 0.01}, {0.5, 0.02}}) {
        const Result<SweptFacets> facets = facets_for(sphere(), detail);
        ASSERT_TRUE(facets);
        const Result<TriangleMesh> mesh = swept_shape(sphere(), *facets);
        double longest = 0, deepest = 0;
        for (const auto& triangle : mesh->triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vector3 a = mesh->positions[triangle[k]];
                const Vector3 b = mesh->positions[triangle[(k + 1) % 3]];
                longest = std::max(longest, static_cast<double>(length(b - a)));
                deepest = std::max(deepest, 1 - static_cast<double>(length((a + b) * 0.5F)));
            }
        }
        EXPECT_LE(longest, detail.longest_edge * (1 + 1e-6));
        EXPECT_LE(deepest, detail.tolerance * (1 + 1e-6));
        // Not many more triangles than needed: edges of the meridian have a chord error of
        // (π/n)²/8.
        const double needed =
            std::max(pi / detail.longest_edge, pi / std::sqrt(4 * detail.tolerance));
        EXPECT_LE(facets->along, 2.5 * needed + 3);
    }
}

TEST(SweptShape, NamesThePlaceThatIsNotFinite) {
    const SweptSurface torn = [](double t, double s) {
        return t > 0.45 && s > 0.7 ? Vector3d{0, std::numeric_limits<double>::infinity(), 0}
                                   : sphere()(t, s);
    };
    const Result<TriangleMesh> mesh = swept_shape(torn, {10, 4});
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().message, "the shape is not finite at t = 0.5, s = 0.75");
    EXPECT_FALSE(facets_for(torn, {0.1, 0.1}));
    const Result<TriangleMesh> shaded =
        swept_shape(sphere(), {4, 4}, [](double t, double) { return t > 0.6 ? std::nan("") : 1; });
    ASSERT_FALSE(shaded);
    EXPECT_EQ(shaded.error().message, "the shade is not finite at t = 0.75, s = 0");
}

TEST(SweptShape, RefusesWhatHasNoVolumeOrIsTooFine) {
    const SweptSurface flat = [](double t, double s) { return Vector3d{s, t, 0}; };
    EXPECT_EQ(swept_shape(flat, {4, 4}).error().message, "the shape encloses no volume");
    EXPECT_THAT(facets_for(sphere(), {1e-4, 1}).error().message,
                testing::HasSubstr("more than 1024 facets along t"));
}

}  // namespace
}  // namespace cascade
