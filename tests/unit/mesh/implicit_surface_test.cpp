// Surfaces of functions whose areas, volumes and topology are known.
#include "mesh/implicit_surface.h"

#include "tests/support/never.h"
#include "unit/mesh/measures.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

namespace cascade {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

/// Turns a function of one point into a function of many points.
template <typename F>
ImplicitFunction each(F f) {
    return [f](std::span<const Vector3d> points, std::span<double> values) {
        for (std::size_t k = 0; k < points.size(); ++k) values[k] = f(points[k]);
    };
}

using test::never;

template <typename F>
SurfaceMesh surface(F f, const ImplicitRequest& request) {
    Result<SurfaceMesh> made = implicit_surface(each(f), request, never);
    EXPECT_TRUE(made) << made.error().message;
    if (!made) return {};
    test::expect_closed(*made);
    for (const Vector3d& p : made->points) {
        // Vertices are on the surface.
        EXPECT_LT(std::abs(f(p)), 1e-6) << p.x << " " << p.y << " " << p.z;
    }
    return *std::move(made);
}

template <typename F>
std::string fault(F f, const ImplicitRequest& request = {}) {
    const auto made = implicit_surface(each(f), request, never);
    return made ? std::string("made") : made.error().message;
}

double ball(Vector3d p) { return 0.8 - length(p); }
double ring(Vector3d p) { return 0.3 - std::hypot(std::hypot(p.x, p.z) - 1, p.y); }

TEST(ImplicitSurface, ASphere) {
    double last_area = 0, last_volume = 0;
    for (const double edge : {0.2, 0.1, 0.05}) {
        const SurfaceMesh sphere = surface(ball, {{-1, -1, -1}, {1, 1, 1}, edge});
        EXPECT_EQ(facts_of(sphere).euler_characteristic, 2);
        EXPECT_EQ(facts_of(sphere).components, 1u);
        EXPECT_GT(test::smallest_angle(sphere), 25);
        EXPECT_NEAR(test::mean_edge(sphere) / edge, 1, 0.2);
        const double area = 4 * pi * 0.64 - sphere.total_area();
        const double volume = 4 * pi / 3 * 0.512 - test::volume_of(sphere);
        EXPECT_LT(area, 4 * pi * edge * edge / 4);
        EXPECT_LT(volume, 4 * pi * edge * edge / 4);
        if (last_area > 0) {
            EXPECT_NEAR(last_area / area, 4, 1);
            EXPECT_NEAR(last_volume / volume, 4, 1);
        }
        last_area = area;
        last_volume = volume;
        for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t) {
            EXPECT_GT(dot(sphere.double_area_normal(t), sphere.corner(t, 0)), 0);
        }
    }
}

TEST(ImplicitSurface, ATorus) {
    double last = 0;
    for (const double edge : {0.1, 0.05}) {
        const SurfaceMesh torus = surface(ring, {{-1.5, -0.5, -1.5}, {1.5, 0.5, 1.5}, edge});
        EXPECT_EQ(facts_of(torus).euler_characteristic, 0);
        EXPECT_EQ(facts_of(torus).components, 1u);
        EXPECT_GT(test::smallest_angle(torus), 20);
        EXPECT_NEAR(torus.total_area() / (4 * pi * pi * 0.3), 1, 3 * edge * edge);
        const double volume = 2 * pi * pi * 0.09 - test::volume_of(torus);
        if (last > 0) {
            EXPECT_NEAR(last / volume, 4, 1);
        }
        last = volume;
        // By Gauss and Bonnet, the outer half has the curvature of a sphere, and the inner half the
        // negative of it.
        const std::vector<double> defects = test::angle_defects(torus);
        double outer = 0, all = 0;
        for (std::size_t k = 0; k < defects.size(); ++k) {
            all += defects[k];
            if (std::hypot(torus.points[k].x, torus.points[k].z) > 1) outer += defects[k];
        }
        EXPECT_NEAR(all, 0, 1e-9);
        EXPECT_NEAR(outer / (4 * pi), 1, edge);
    }
}

TEST(ImplicitSurface, TwoHoles) {
    const auto eight = [](Vector3d p) {  // A thickened lemniscate.
        const double x = p.x * p.x, y = p.y * p.y;
        const double curve = x * (x - 1) + y;
        return 0.01 - curve * curve - p.z * p.z;
    };
    const SurfaceMesh mesh = surface(eight, {{-1.3, -1, -0.3}, {1.3, 1, 0.3}, 0.03});
    EXPECT_EQ(facts_of(mesh).euler_characteristic, -2);
    EXPECT_EQ(facts_of(mesh).components, 1u);
    EXPECT_GT(test::smallest_angle(mesh), 10);
}

TEST(ImplicitSurface, SeveralPieces) {
    const auto shell = [](Vector3d p) {  // A ball with a hollow ball in its middle.
        return std::min(0.8 - length(p), length(p) - 0.5);
    };
    const SurfaceMesh mesh = surface(shell, {{-1, -1, -1}, {1, 1, 1}, 0.08});
    EXPECT_EQ(facts_of(mesh).components, 2u);
    EXPECT_EQ(facts_of(mesh).euler_characteristic, 4);
    EXPECT_NEAR(test::volume_of(mesh), 4 * pi / 3 * (0.512 - 0.125), 0.02);
}

TEST(ImplicitSurface, EdgesOfAFunctionAreBluntedAndClosed) {
    const auto cube = [](Vector3d p) {
        return 0.5 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    };
    const SurfaceMesh mesh = surface(cube, {{-1, -1, -1}, {1, 1, 1}, 0.06});
    EXPECT_EQ(facts_of(mesh).euler_characteristic, 2);
    EXPECT_NEAR(test::volume_of(mesh), 1, 0.02);
    // A function that only distinguishes inside and outside.
    const auto sign = [](Vector3d p) { return length(p) < 0.7 ? 1.0 : -1.0; };
    const auto made = implicit_surface(each(sign), {{-1, -1, -1}, {1, 1, 1}, 0.1}, never);
    ASSERT_TRUE(made);
    test::expect_closed(*made);
    for (const Vector3d& p : made->points) EXPECT_NEAR(length(p), 0.7, 1e-9);
}

TEST(ImplicitSurface, RandomWavesAlwaysClose) {
    // Much finer than the lattice: all cases of tetrahedra occur, including corners at 0.
    const auto waves = [](Vector3d p) {
        const double f =
            std::round(3 * (std::sin(23 * p.x + 3 * p.y) * std::sin(19 * p.y - 5 * p.z) +
                            std::sin(29 * p.z + 7 * p.x)));
        const double wall = 0.9 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        return std::min(f, wall);
    };
    const auto made = implicit_surface(each(waves), {{-1, -1, -1}, {1, 1, 1}, 0.09}, never);
    ASSERT_TRUE(made);
    test::expect_closed(*made);
    EXPECT_GT(facts_of(*made).triangles, 1000u);
    EXPECT_GT(test::volume_of(*made), 0);
}

TEST(ImplicitSurface, SizesAndPlacesOfAllOrders) {
    for (const double size : {1e-9, 1e9}) {
        const auto sphere = [size](Vector3d p) { return 0.8 - length(p * (1 / size)); };
        const SurfaceMesh mesh =
            surface(sphere, {{-size, -size, -size}, {size, size, size}, 0.2 * size});
        EXPECT_NEAR(mesh.total_area() / (4 * pi * 0.64 * size * size), 1, 0.03);
    }
    // If scaled by a power of two, triangles have the same bits.
    const auto triangles = [](double size) {
        const auto sphere = [size](Vector3d p) { return 0.8 - length(p * (1 / size)); };
        return surface(sphere, {{-size, -size, -size}, {size, size, size}, 0.25 * size}).triangles;
    };
    EXPECT_EQ(triangles(std::ldexp(1, 160)), triangles(1));
    EXPECT_EQ(triangles(std::ldexp(1, -160)), triangles(1));
    const auto small = [](Vector3d p) { return 0.3 - length(p - Vector3d{5, 6, 7}); };
    const SurfaceMesh mesh = surface(small, {{4.5, 5.5, 6.6}, {5.5, 6.5, 7.4}, 0.1});
    EXPECT_NEAR(mesh.total_area(), 4 * pi * 0.09, 0.1);
}

TEST(ImplicitSurface, CellsOfAnyFormClose) {
    // A lattice of one cell, a box of one layer, and a box much longer than wide.
    const SurfaceMesh one = surface(ball, {{-1, -1, -1}, {1, 1, 1}, 5});
    EXPECT_EQ(facts_of(one).euler_characteristic, 2);
    const SurfaceMesh flat = surface([](Vector3d p) { return 0.01 - dot(p, p) + 0.99 * p.x * p.x; },
                                     {{-1.5, -0.15, -0.11}, {1.5, 0.15, 0.11}, 0.2});
    EXPECT_EQ(facts_of(flat).euler_characteristic, 2);
    EXPECT_GT(test::volume_of(flat), 0);
}

TEST(ImplicitSurface, WhatCannotBeDoneIsSaid) {
    EXPECT_THAT(fault([](Vector3d p) { return 1.2 - length(p); }),
                HasSubstr("the surface leaves the box: its function is "));
    EXPECT_THAT(fault([](Vector3d) { return -1.0; }),
                HasSubstr("is not above 0 at any sampled point"));
    EXPECT_THAT(fault([](Vector3d) { return 0.0; }),
                HasSubstr("is not above 0 at any sampled point"));
    EXPECT_THAT(fault([](Vector3d) { return 1.0; }), HasSubstr("leaves the box"));
    EXPECT_THAT(fault([](Vector3d p) { return std::sqrt(0.3 - p.x); }), HasSubstr("nan at (0.3"));
    EXPECT_THAT(fault([](Vector3d p) { return 1 / dot(p, p) - 4; }, {{-1, -1, -1}, {1, 1, 1}, 0.1}),
                HasSubstr("the function of the surface is inf at (0, 0, 0)"));
    EXPECT_THAT(fault(ball, {{-1, -1, -1}, {1, 1, 1}, 1e-4}), HasSubstr("1.6e+13 points"));
    EXPECT_THAT(fault(ball, {{-1, -1, -1}, {1, 1, -1}, 0.1}), HasSubstr("holds no surface"));
    EXPECT_THAT(fault(ball, {{-1, -1, -1}, {1, 1, 1}, std::nan("")}),
                HasSubstr("holds no surface"));
    EXPECT_THAT(fault(ball, {{-1, -1, -1}, {1, std::numeric_limits<double>::infinity(), 1}, 1}),
                HasSubstr("holds no surface"));
}

TEST(ImplicitSurface, IsGivenUpAndTellsHowFarItIs) {
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(implicit_surface(each(ball), {}, stop));
    std::vector<double> told;
    ASSERT_TRUE(implicit_surface(each(ball), {{-1, -1, -1}, {1, 1, 1}, 0.2}, never,
                                 [&](double part) { told.push_back(part); }));
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1);
    EXPECT_GT(told.size(), 10u);
}

}  // namespace
}  // namespace cascade
