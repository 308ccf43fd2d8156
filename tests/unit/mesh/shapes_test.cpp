// Shapes whose areas, volumes and forms are known.
#include "mesh/shapes.h"

#include "unit/mesh/measures.h"

#include <gmock/gmock.h>

#include <limits>

namespace cascade {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

SurfaceMesh shape(Result<SurfaceMesh> made) {
    EXPECT_TRUE(made) << made.error().message;
    if (!made) return {};
    test::expect_closed(*made);
    EXPECT_GT(test::volume_of(*made), 0) << "it faces outwards";
    EXPECT_EQ(made->texture.size(), made->triangles.size());
    return *std::move(made);
}

/// Expects that no triangle is mirrored in the texture, and that coordinates are in the unit
/// square, except for parts beyond a seam.
void expect_texture_unfolds(const SurfaceMesh& mesh, float beyond) {
    for (const auto& [a, b, c] : mesh.texture) {
        EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0);
        for (const TexturePlace& place : {a, b, c}) {
            EXPECT_TRUE(place[0] >= 0 && place[0] <= 1 + beyond) << place[0];
            EXPECT_TRUE(place[1] >= 0 && place[1] <= 1) << place[1];
        }
    }
}

TEST(Shapes, ASphereOfEvenTriangles) {
    double last = 0;
    for (const double edge : {0.4, 0.2, 0.1}) {
        const SurfaceMesh sphere = shape(sphere_mesh(2, edge));
        EXPECT_EQ(facts_of(sphere).euler_characteristic, 2);
        EXPECT_NEAR(test::mean_edge(sphere), edge, 0.06 * edge);
        EXPECT_GT(test::smallest_angle(sphere), 50);
        for (const Vector3d& p : sphere.points) EXPECT_NEAR(length(p), 2, 1e-14);
        const double missing = 4 * pi * 4 - sphere.total_area();
        if (last > 0) {
            EXPECT_NEAR(last / missing, 4, 0.3) << "the error is of second order";
        }
        last = missing;
        expect_texture_unfolds(sphere, 0.2001F);  // At a pole, five triangles make a full turn.
        double least = 1e9, most = 0;
        for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
            least = std::min(least, sphere.area(t));
            most = std::max(most, sphere.area(t));
        }
        EXPECT_LT(most / least, 1.35);
    }
    EXPECT_LT(last, 4 * pi * 4 * 0.001);
}

TEST(Shapes, ASphereOfLongEdgesIsAnIcosahedron) {
    const SurfaceMesh sphere = shape(sphere_mesh(1, 10));
    EXPECT_EQ(sphere.triangles.size(), 20u);
    EXPECT_NEAR(test::smallest_angle(sphere), 60, 1e-9);
}

TEST(Shapes, ATorus) {
    double last = 0;
    for (const double edge : {0.2, 0.1, 0.05}) {
        const SurfaceMesh torus = shape(torus_mesh(1.5, 0.5, edge));
        EXPECT_EQ(facts_of(torus).euler_characteristic, 0);
        expect_texture_unfolds(torus, 0);
        const double missing = 2 * pi * 1.5 * pi * 0.25 - test::volume_of(torus);
        if (last > 0) {
            EXPECT_NEAR(last / missing, 4, 0.4);
        }
        last = missing;
        EXPECT_NEAR(torus.total_area() / (4 * pi * pi * 0.75), 1, 2 * edge * edge);
        EXPECT_NEAR(facts_of(torus).high.y, 0.5, edge * edge) << "y is the axis";
    }
    // The curvature of the outer half is 4π, of the inner −4π.
    const SurfaceMesh torus = shape(torus_mesh(1.5, 0.5, 0.05));
    double outer = 0, all = 0;
    const std::vector<double> defects = test::angle_defects(torus);
    for (std::size_t k = 0; k < defects.size(); ++k) {
        const Vector3d p = torus.points[k];
        all += defects[k];
        if (std::hypot(p.x, p.z) > 1.5) outer += defects[k];
    }
    EXPECT_NEAR(all, 0, 1e-9);
    EXPECT_NEAR(outer, 4 * pi, 0.05 * 4 * pi);
}

TEST(Shapes, ABoxHasSharpEdges) {
    const SurfaceMesh box = shape(box_mesh({1, 2, 3}, 0.25));
    EXPECT_EQ(facts_of(box).euler_characteristic, 2);
    EXPECT_NEAR(box.total_area(), 22, 1e-12);
    EXPECT_NEAR(test::volume_of(box), 6, 1e-12);
    EXPECT_EQ(box.triangles.size(), 4u * (4 * 8 + 8 * 12 + 12 * 4));
    EXPECT_EQ(facts_of(box).low, (Vector3d{-0.5, -1, -1.5}));
    EXPECT_NEAR(test::smallest_angle(box), 45, 1e-9);
    // Only the eight corners have curvature, π/2 each.
    for (const double defect : test::angle_defects(box)) {
        EXPECT_TRUE(std::abs(defect) < 1e-12 || std::abs(defect - pi / 2) < 1e-12);
    }
    expect_texture_unfolds(box, 0);
    // The scale is the same everywhere: a triangle has the same fraction of the texture as of the
    // area.
    for (std::size_t t = 0; t < box.triangles.size(); ++t) {
        const auto& [a, b, c] = box.texture[t];
        const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        EXPECT_NEAR(area * 64 / box.area(t), 1, 1e-4);
    }
    EXPECT_EQ(shape(box_mesh({1, 1, 1}, 7)).triangles.size(), 12u);
}

TEST(Shapes, SizesOfAllOrders) {
    for (const double size : {1e-50, 1e-9, 1e9, 1e50}) {
        const SurfaceMesh sphere = shape(sphere_mesh(size, size / 4));
        EXPECT_NEAR(sphere.total_area() / (4 * pi * size * size), 1, 0.02);
    }
}

TEST(Shapes, WhatIsNoShapeIsRefused) {
    const auto fault = [](const Result<SurfaceMesh>& made) {
        return made ? std::string("made") : made.error().message;
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(fault(sphere_mesh(-1, 0.1)), "the radius -1 is not a length that a surface can have");
    EXPECT_EQ(fault(sphere_mesh(nan, 0.1)),
              "the radius nan is not a length that a surface can have");
    EXPECT_EQ(fault(sphere_mesh(1, 0)), "the edge 0 is not a length that a surface can have");
    EXPECT_THAT(fault(sphere_mesh(1, 1e-9)),
                HasSubstr("triangles, but at most 1.68e+07 are allowed"));
    EXPECT_THAT(fault(torus_mesh(1, 1, 0.1)), HasSubstr("would cross itself"));
    EXPECT_THAT(fault(torus_mesh(1, nan, 0.1)), HasSubstr("the tube's radius nan"));
    EXPECT_THAT(fault(box_mesh({1, 0, 1}, 0.1)), HasSubstr("the side 0"));
    EXPECT_THAT(fault(box_mesh({1e50, 1, 1}, 1)), HasSubstr("triangles"));
}

TEST(Shapes, AKnotIsATubeAroundACurve) {
    // By Pappus, a tube has the area and volume of a straight tube with the curve's length.
    constexpr double along = 28.82629;
    for (const double radius : {0.2, 0.5}) {
        const SurfaceMesh knot = shape(knot_mesh(radius, 0.05));
        EXPECT_EQ(facts_of(knot).euler_characteristic, 0);
        EXPECT_NEAR(knot.total_area(), 2 * pi * radius * along, 0.004 * knot.total_area());
        EXPECT_NEAR(test::volume_of(knot), pi * radius * radius * along,
                    0.15 * radius * radius * along);
        EXPECT_GT(test::smallest_angle(knot), 15);
    }
    EXPECT_FALSE(knot_mesh(0.6, 0.05));
    EXPECT_FALSE(knot_mesh(0, 0.05));
    EXPECT_FALSE(knot_mesh(0.3, 0));
    EXPECT_FALSE(knot_mesh(0.3, 1e-9));
    EXPECT_FALSE(knot_mesh(NAN, 0.05));
}

}  // namespace
}  // namespace cascade
