// Places that are added to the points of a surface, and holes that are cut into triangles.
#include "core/hash.h"
#include "surface/fill_hole.h"
#include "surface/mutual_tessellation.h"
#include "surface/place_lattice.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace cascade {
namespace {

using test::never;

TEST(PlaceLattice, KnowsCornersAndEdges) {
    const SurfaceMesh mesh = test::square();
    const std::vector<SurfacePlace> places = {{0, {0, 1, 0}},
                                              {0, {0.25, 0, 0.75}},
                                              {1, {0.2, 0.3, 0.5}}};
    const auto lattice = to_lattice(mesh, places);
    ASSERT_TRUE(lattice);
    EXPECT_EQ((*lattice)[0].corner(), 1u);
    EXPECT_EQ((*lattice)[0].edge(), 3u);
    EXPECT_EQ((*lattice)[1].corner(), 3u);
    EXPECT_EQ((*lattice)[1].edge(), 2u);  // From corner 2 to corner 0.
    EXPECT_EQ((*lattice)[1].steps, (Steps{lattice_steps / 4, 0, 3 * lattice_steps / 4}));
    EXPECT_EQ((*lattice)[2].edge(), 3u);
    const Steps across = steps_across((*lattice)[1].steps, 2, 1);
    EXPECT_EQ(across, (Steps{0, lattice_steps / 4, 3 * lattice_steps / 4}));
}

TEST(PlaceLattice, NoTwoPlacesCoincide) {
    const SurfaceMesh mesh = test::box();
    std::vector<SurfacePlace> places;
    for (std::uint32_t t = 0; t < 12; ++t) {
        for (int k = 0; k < 200; ++k) places.push_back({t, {0, 0.5, 0.5}});
        for (int k = 0; k < 200; ++k) places.push_back({t, {0, 0, 1}});
        for (int k = 0; k < 200; ++k) places.push_back({t, {0.5, 0.25, 0.25}});
    }
    const auto lattice = to_lattice(mesh, places);
    ASSERT_TRUE(lattice);
    std::set<std::array<double, 3>> positions;
    for (const LatticePlace& place : *lattice) {
        SurfacePlace found{place.triangle, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_GE(place.steps[k], 0);
            found.weights[k] = static_cast<double>(place.steps[k]) / lattice_steps;
        }
        const Vector3d p = position_of(mesh, found);
        positions.insert({p.x, p.y, p.z});
    }
    EXPECT_EQ(positions.size(), places.size());
}

/// Positive if d is within the circle through a, b and c. All points have z = 0.
double in_circle(Vector3d a, Vector3d b, Vector3d c, Vector3d d) {
    const auto lifted = [&](Vector3d p) {
        return Vector3d{p.x - d.x, p.y - d.y, dot(p - d, p - d)};
    };
    return dot(lifted(a), cross(lifted(b), lifted(c)));
}

TEST(MutualTessellation, IsDelaunayWithinEachTriangle) {
    const SurfaceMesh mesh = test::square();
    const std::vector<SurfacePlace> places = scatter(mesh, 2000, 5);
    auto edited = half_edges(mesh);
    ASSERT_TRUE(edited && tessellate(*edited, mesh, places, never));
    const SurfaceMesh fine = surface_mesh(*edited);
    test::expect_manifold(fine);
    EXPECT_EQ(fine.triangles.size(), 2u + 2 * 2000);
    EXPECT_NEAR(fine.total_area(), 1, 1e-12);
    const auto side = [](Vector3d p) { return p.x - p.y; };  // 0 on the diagonal.
    std::size_t tested = 0;
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        EXPECT_GT(fine.double_area_normal(t).z, 0);
        for (std::size_t k = 0; k < 3; ++k) {
            const TriangleEdge other = fine.across[t][k];
            if (!other.exists()) continue;
            const Vector3d c = fine.corner(t, (k + 2) % 3),
                           d = fine.corner(other.triangle, (other.edge + 2) % 3);
            if (side(c) * side(d) < 0 && side(fine.corner(t, k)) == 0) continue;
            EXPECT_LT(in_circle(fine.corner(t, 0), fine.corner(t, 1), fine.corner(t, 2), d), 1e-12);
            ++tested;
        }
    }
    EXPECT_GT(tested, 11'000u);
}

TEST(MutualTessellation, LiesInTheOldSurface) {
    const SurfaceMesh mesh = test::box();
    std::vector<SurfacePlace> places = scatter(mesh, 700, 2);
    for (std::uint32_t t = 0; t < 12; ++t) places.push_back({t, {0.5, 0, 0.5}});
    auto edited = half_edges(mesh);
    ASSERT_TRUE(edited && tessellate(*edited, mesh, places, never));
    const SurfaceMesh fine = surface_mesh(*edited);
    test::expect_manifold(fine);
    EXPECT_EQ(fine.points.size(), 8 + places.size());  // Also where places coincide.
    EXPECT_NEAR(fine.total_area(), 6, 1e-12);
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        const Vector3d n = unit(fine.double_area_normal(t));
        EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);
        const Vector3d middle =
            (fine.corner(t, 0) + fine.corner(t, 1) + fine.corner(t, 2)) * (1.0 / 3);
        EXPECT_GT(dot(n, middle - Vector3d{0.5, 0.5, 0.5}), 0);
    }
}

TEST(FillHole, AFlatFanUnrollsToItself) {
    const std::vector<double> distances = {1, 2, 0.5, 3, 1.5};
    const std::vector<double> angles = {1, 0.8, 1.2, 1.5, 2 * std::numbers::pi - 4.5};
    double direction = 0;
    const std::vector<Vector2d> ring = unroll(distances, angles);
    for (std::size_t k = 0; k < ring.size(); ++k) {
        EXPECT_NEAR(ring[k].x, distances[k] * std::cos(direction), 1e-12);
        EXPECT_NEAR(ring[k].y, distances[k] * std::sin(direction), 1e-12);
        direction += angles[k];
    }
    const std::vector<Vector2d> open =
        unroll(std::vector<double>{1, 1, 1}, std::vector<double>{0.1, 0.3});
    EXPECT_NEAR(open[2].x, -1, 1e-12);
    EXPECT_NEAR(open[1].x, std::cos(std::numbers::pi / 4), 1e-12);
}

/// Points in order around the origin, at different distances.
std::vector<Vector2d> star(std::uint32_t count, std::uint32_t seed, double unevenness) {
    std::vector<Vector2d> ring;
    for (std::uint32_t k = 0; k < count; ++k) {
        const double random = pcg4d({k, seed, 0, 1})[0] / 4294967296.0;
        const double angle = 2 * std::numbers::pi * (k + 0.3 * random) / count;
        const double distance = 1 + unevenness * pcg4d({k, seed, 0, 2})[0] / 4294967296.0;
        ring.push_back({distance * std::cos(angle), distance * std::sin(angle)});
    }
    return ring;
}

double area(const std::vector<Vector2d>& ring, const RingTriangle& t) {
    return cross(ring[t[1]] - ring[t[0]], ring[t[2]] - ring[t[0]]) / 2;
}

/// The smallest sine of the triangle's angles, which is negative if the triangle is upside down.
double least_sine(const std::vector<Vector2d>& ring, const RingTriangle& t) {
    std::array<double, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) sides[k] = length(ring[t[(k + 1) % 3]] - ring[t[k]]);
    std::sort(sides.begin(), sides.end());
    return 2 * area(ring, t) / (sides[1] * sides[2]);
}

/// Expects that the triangles have the right orientation and fill the ring.
void expect_filled(const std::vector<Vector2d>& ring, const std::vector<RingTriangle>& triangles) {
    ASSERT_EQ(triangles.size() + 2, ring.size());
    double sum = 0, whole = 0;
    for (const RingTriangle& t : triangles) {
        EXPECT_GT(area(ring, t), 0);
        sum += area(ring, t);
    }
    for (std::size_t k = 0; k < ring.size(); ++k)
        whole += cross(ring[k], ring[(k + 1) % ring.size()]) / 2;
    EXPECT_NEAR(sum, whole, 1e-12 * whole);
}

TEST(FillHole, AllTrianglesTogetherAreTheHole) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        const std::vector<Vector2d> ring = star(3 + seed % 20, seed, seed % 3);
        const auto cut = cut_ears(ring, true, [](const RingTriangle&) { return true; });
        expect_filled(ring, cut);
        const auto worth = [&](const RingTriangle& t) {
            return std::max(0.0, least_sine(ring, t));
        };
        const auto best = best_triangles(static_cast<std::uint32_t>(ring.size()), worth);
        expect_filled(ring, best);
        const auto worst = [&](const std::vector<RingTriangle>& triangles) {
            double least = 1;
            for (const RingTriangle& t : triangles) least = std::min(least, least_sine(ring, t));
            return least;
        };
        EXPECT_GE(worst(best), worst(cut) - 1e-15);
    }
}

TEST(FillHole, EarsOfAConvexRimMakeDelaunayTriangles) {
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const std::vector<Vector2d> ring = star(12, seed, 0);  // On a circle.
        std::vector<Vector2d> bent = ring;
        for (Vector2d& p : bent) p.x *= 1.5;  // On an ellipse.
        const auto at = [&](std::uint32_t k) { return Vector3d{bent[k].x, bent[k].y, 0}; };
        for (const RingTriangle& t :
             cut_ears(bent, true, [](const RingTriangle&) { return true; })) {
            for (std::uint32_t k = 0; k < bent.size(); ++k) {
                if (k == t[0] || k == t[1] || k == t[2]) continue;
                EXPECT_LT(in_circle(at(t[0]), at(t[1]), at(t[2]), at(k)), 1e-12);
            }
        }
    }
}

TEST(FillHole, WhatMayNotBeMadeIsNotMade) {
    const std::vector<Vector2d> ring = star(6, 1, 0);
    const auto not_from_first = [](const RingTriangle& t) {
        return t[0] != 0 && t[1] != 0 && t[2] != 0;
    };
    EXPECT_TRUE(cut_ears(ring, true, not_from_first).empty());  // Point 0 has no triangle.
    EXPECT_TRUE(best_triangles(6, [&](const RingTriangle& t) {
                    return not_from_first(t) ? 1.0 : 0;
                }).empty());
    const auto no_long_line = [](const RingTriangle& t) {
        return std::max(t[2], t[0]) - std::min(t[2], t[0]) != 3;
    };
    const std::vector<RingTriangle> found = cut_ears(ring, true, no_long_line);
    EXPECT_EQ(found.size(), 4u);
    for (const RingTriangle& t : found) EXPECT_TRUE(no_long_line(t));
}

}  // namespace
}  // namespace cascade
