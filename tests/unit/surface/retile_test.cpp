// Surfaces that are tiled anew, compared with theory.
#include "surface/triangle_quality.h"
#include "unit/surface/retiling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade {
namespace {

using test::even_places;
using test::expect_same_topology;
using test::farthest_moved;
using test::never;
using test::torus_soup;

SurfaceMesh torus_mesh(std::uint32_t n, std::uint32_t m) {
    return make_mesh(torus_soup(n, m))->mesh;
}

/// The square from 0 to 1 along both axes, made of n² squares.
SurfaceMesh fine_square(std::uint32_t n) {
    PolygonSoup soup;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            soup.points.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n, 0});
            if (i == n || j == n) continue;
            const std::uint32_t corner = j * (n + 1) + i;
            for (const std::uint32_t at : {corner, corner + 1, corner + n + 2, corner + n + 1}) {
                soup.corners.push_back(at);
            }
            soup.ends.push_back(soup.corners.size());
        }
    }
    return make_mesh(std::move(soup))->mesh;
}

/// Two separate rings, and a cube without its lid.
SurfaceMesh three_pieces() {
    PolygonSoup soup = torus_soup(24, 12);
    test::append(soup, torus_soup(16, 9), {4, 0, 0});
    PolygonSoup open = test::cube();
    open.corners.resize(20);
    open.ends.pop_back();
    test::append(soup, open, {0, 4, 0});
    return make_mesh(std::move(soup))->mesh;
}

double distance_to_triangle(Vector3d p, Vector3d a, Vector3d b, Vector3d c) {
    const Vector3d normal = cross(b - a, c - a);
    const auto side = [&](Vector3d from, Vector3d to) {
        return dot(cross(to - from, p - from), normal);
    };
    if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) {
        return std::abs(dot(p - a, normal)) / length(normal);
    }
    const auto to_segment = [&](Vector3d from, Vector3d to) {
        const Vector3d along = to - from;
        const double part = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
        return length(p - from - along * part);
    };
    return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

/// The largest distance of the corners and centres of the triangles of `from` to the surface `to`.
double distance_from(const SurfaceMesh& from, const SurfaceMesh& to) {
    double farthest = 0;
    const auto look = [&](Vector3d p) {
        double nearest = 1e9;
        for (std::size_t t = 0; t < to.triangles.size(); ++t) {
            nearest = std::min(nearest, distance_to_triangle(p, to.corner(t, 0), to.corner(t, 1),
                                                             to.corner(t, 2)));
        }
        farthest = std::max(farthest, nearest);
    };
    for (const Vector3d& p : from.points) look(p);
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        look((from.corner(t, 0) + from.corner(t, 1) + from.corner(t, 2)) * (1.0 / 3));
    }
    return farthest;
}

/// The number of new triangles whose normal points against the mean normal of the old triangles in
/// which their corners are.
std::size_t upside_down(const SurfaceMesh& mesh, const std::vector<SurfacePlace>& places,
                        const Retiled& retiled) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < retiled.mesh.triangles.size(); ++t) {
        Vector3d old;
        bool is_of_places = true;
        for (const std::uint32_t point : retiled.mesh.triangles[t]) {
            is_of_places &= point < places.size();
            if (is_of_places) old = old + unit(mesh.double_area_normal(places[point].triangle));
        }
        count += is_of_places && dot(retiled.mesh.double_area_normal(t), old) <= 0;
    }
    return count;
}

double spacing(const SurfaceMesh& mesh, std::size_t places) {
    return std::sqrt(mesh.total_area() / static_cast<double>(places));
}

TEST(Retile, KeepsTopologyPointsAndShape) {
    struct Case {
        SurfaceMesh mesh;
        std::size_t places;
        double distance;  ///< The allowed distance, in spacings.
    };
    for (const auto& [mesh, count, distance] :
         {Case{test::sphere(12), 600, 0.1}, Case{torus_mesh(40, 20), 700, 0.25},
          Case{test::box(), 500, 0.75}, Case{three_pieces(), 900, 0.6},
          Case{test::sphere(24), 150, 0.2}}) {
        const std::vector<SurfacePlace> places = even_places(mesh, count);
        const Result<Retiled> retiled = retile(mesh, places, never);
        ASSERT_TRUE(retiled) << retiled.error().message;
        expect_same_topology(mesh, *retiled, count);
        EXPECT_LT(farthest_moved(mesh, places, *retiled), 2e-7);
        for (const KeptPoint& kept : retiled->kept) EXPECT_EQ(kept.why, WhyKept::boundary);
        EXPECT_EQ(upside_down(mesh, places, *retiled), 0u);
        const double h = spacing(mesh, count);
        EXPECT_LT(distance_from(mesh, retiled->mesh), distance * h) << count;
        EXPECT_LT(distance_from(retiled->mesh, mesh), distance * h) << count;
        EXPECT_NEAR(retiled->mesh.total_area() / mesh.total_area(), 1, 0.03) << count;
    }
}

TEST(Retile, AreaOfASphereComesAtTheSecondOrder) {
    const SurfaceMesh mesh = test::sphere(24);
    std::vector<double> missing;
    for (const std::size_t count : {60, 240, 960}) {
        const Result<Retiled> retiled = retile(mesh, even_places(mesh, count), never);
        ASSERT_TRUE(retiled);
        EXPECT_TRUE(retiled->kept.empty());
        EXPECT_EQ(retiled->mesh.triangles.size(), 2 * count - 4);
        for (std::size_t t = 0; t < retiled->mesh.triangles.size(); ++t) {
            EXPECT_GT(dot(retiled->mesh.double_area_normal(t), retiled->mesh.corner(t, 0)), 0);
        }
        missing.push_back(4 * std::numbers::pi - retiled->mesh.total_area());
    }
    // Triangles of a fourth of the area leave a fourth of the missing area. The old mesh itself
    // misses some, too.
    const double old = 4 * std::numbers::pi - mesh.total_area();
    EXPECT_NEAR((missing[0] - old) / (missing[1] - old), 4, 0.3);
    EXPECT_NEAR((missing[1] - old) / (missing[2] - old), 4, 0.3);
}

TEST(Retile, TrianglesOfEvenPlacesAreGood) {
    const SurfaceMesh mesh = test::sphere(16);
    const Result<Retiled> retiled = retile(mesh, even_places(mesh, 800), never);
    double least = 1;
    for (std::size_t t = 0; t < retiled->mesh.triangles.size(); ++t) {
        least = std::min(least, quality_of({retiled->mesh.corner(t, 0), retiled->mesh.corner(t, 1),
                                            retiled->mesh.corner(t, 2)},
                                           {})
                                    .least_sine);
    }
    EXPECT_GT(least, std::sin(25 * std::numbers::pi / 180));
}

TEST(Retile, StraightBoundariesNeedOnlyTheirCorners) {
    const SurfaceMesh mesh = fine_square(12);
    const std::vector<SurfacePlace> places = even_places(mesh, 200);
    const Result<Retiled> retiled = retile(mesh, places, never);
    ASSERT_TRUE(retiled);
    expect_same_topology(mesh, *retiled, 200);
    EXPECT_NEAR(retiled->mesh.total_area(), 1, 1e-6);
    EXPECT_LT(retiled->kept.size(), 12u);  // The boundary has 48 points.
    EXPECT_GE(retiled->kept.size(), 4u);
    for (const KeptPoint& kept : retiled->kept) EXPECT_EQ(kept.why, WhyKept::boundary);
    for (const auto& [a, b, c] : retiled->mesh.triangles) {
        EXPECT_GT(cross(retiled->mesh.points[b] - retiled->mesh.points[a],
                        retiled->mesh.points[c] - retiled->mesh.points[a])
                      .z,
                  0);
    }
}

TEST(Retile, PlacesMayLieInCornersOnEdgesAndInTheSamePlace) {
    const SurfaceMesh mesh = test::box();
    std::vector<SurfacePlace> places;
    for (std::uint32_t t = 0; t < 12; ++t) {
        for (int round = 0; round < 3; ++round) {
            places.push_back({t, {1, 0, 0}});
            places.push_back({t, {0, 0.5, 0.5}});
            places.push_back({t, {0.25, 0.75, 0}});
            places.push_back({t, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
            places.push_back({t, {1e-12, 1 - 2e-12, 1e-12}});
        }
    }
    const Result<Retiled> retiled = retile(mesh, places, never);
    ASSERT_TRUE(retiled);
    expect_same_topology(mesh, *retiled, places.size());
    EXPECT_TRUE(retiled->kept.empty());  // All corners are places.
    EXPECT_LT(farthest_moved(mesh, places, *retiled), 1e-4);
    EXPECT_NEAR(retiled->mesh.total_area(), 6, 0.06);  // Edges of the box may be cut.
    for (std::size_t a = 0; a < places.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            EXPECT_FALSE(retiled->mesh.points[a] == retiled->mesh.points[b]);
        }
    }
}

TEST(Retile, AThousandPlacesInOnePlace) {
    const SurfaceMesh mesh = test::sphere(4);
    const std::vector<SurfacePlace> places(1000, SurfacePlace{5, {0.2, 0.8, 0}});
    const Result<Retiled> retiled = retile(mesh, places, never);
    ASSERT_TRUE(retiled);
    expect_same_topology(mesh, *retiled, 1000);
    EXPECT_LT(farthest_moved(mesh, places, *retiled), 1e-4);
}

TEST(Retile, TopologyNeedsItsPoints) {
    // P. J. Heawood's bound: (7 + √(49 − 24 χ)) / 2 points at least, 4 on a sphere and 7 on a
    // torus.
    for (const auto& [mesh, least] :
         {std::pair(test::sphere(6), 4u), std::pair(torus_mesh(12, 8), 7u)}) {
        for (std::size_t count = 0; count <= 8; ++count) {
            const std::vector<SurfacePlace> places = scatter(mesh, count, 3);
            const Result<Retiled> retiled = retile(mesh, places, never);
            ASSERT_TRUE(retiled);
            expect_same_topology(mesh, *retiled, count);
            EXPECT_GE(retiled->mesh.points.size(), least);
        }
    }
    const std::vector<SurfacePlace> one = scatter(test::square(), 1, 1);
    const Result<Retiled> retiled = retile(test::square(), one, never);
    EXPECT_EQ(retiled->mesh.points.size(), 5u);
}

TEST(Retile, TwoTrianglesBackToBack) {
    SurfaceMesh pillow;
    pillow.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    pillow.triangles = {{0, 1, 2}, {1, 0, 2}};
    pillow.across = {{TriangleEdge{1, 0}, {1, 2}, {1, 1}}, {TriangleEdge{0, 0}, {0, 2}, {0, 1}}};
    for (std::size_t count = 0; count < 12; ++count) {
        std::vector<SurfacePlace> places = scatter(pillow, count, 1);
        if (count > 5) places[5] = {1, {0, 0.25, 0.75}};
        const Result<Retiled> retiled = retile(pillow, places, never);
        ASSERT_TRUE(retiled);
        expect_same_topology(pillow, *retiled, count);
    }
}

TEST(Retile, AttributesGoWithThePoints) {
    SurfaceMesh mesh = fine_square(10);
    PointAttribute height{"height", {}};
    for (const Vector3d& p : mesh.points)
        height.values.push_back(static_cast<float>(3 * p.x - p.y));
    mesh.attributes.push_back(height);
    const std::vector<SurfacePlace> places = even_places(mesh, 150);
    const Result<Retiled> retiled = retile(mesh, places, never);
    ASSERT_EQ(retiled->mesh.attributes.size(), 1u);
    EXPECT_EQ(retiled->mesh.attributes[0].name, "height");
    const auto& points = retiled->mesh.points;
    ASSERT_EQ(retiled->mesh.attributes[0].values.size(), points.size());
    std::vector<float> values;
    for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_NEAR(retiled->mesh.attributes[0].values[k], 3 * points[k].x - points[k].y, 1e-5);
        if (k < places.size()) values.push_back(static_cast<float>(points[k].x));
    }
    const PointAttribute x = attribute_of(*retiled, "x", values);
    ASSERT_EQ(x.values.size(), points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_NEAR(x.values[k], points[k].x, k < places.size() ? 1e-7 : 0.1);
    }
}

TEST(Retile, APieceWithoutPlacesHasNoValues) {
    PolygonSoup soup = test::cube();
    test::append(soup, test::cube(), {3, 0, 0});
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const std::vector<SurfacePlace> places(1, SurfacePlace{0, {0.3, 0.3, 0.4}});
    const Result<Retiled> retiled = retile(mesh, places, never);
    ASSERT_TRUE(retiled);
    expect_same_topology(mesh, *retiled, 1);
    const PointAttribute seven = attribute_of(*retiled, "seven", std::vector<float>{7});
    for (std::size_t k = 0; k < seven.values.size(); ++k) {
        if (retiled->mesh.points[k].x < 2) EXPECT_EQ(seven.values[k], 7);
        else EXPECT_TRUE(std::isnan(seven.values[k]));
    }
}

TEST(Retile, RefusesPlacesBesideTheSurface) {
    const SurfaceMesh mesh = test::box();
    for (const SurfacePlace& bad :
         {SurfacePlace{12, {1, 0, 0}}, SurfacePlace{0, {0.5, 0.6, -0.1}},
          SurfacePlace{0, {1, 1, 0}}, SurfacePlace{0, {std::nan(""), 0, 1}},
          SurfacePlace{0, {1e300, -1e300, 1}}}) {
        const std::vector<SurfacePlace> places = {SurfacePlace{}, bad};
        const Result<Retiled> retiled = retile(mesh, places, never);
        ASSERT_FALSE(retiled);
        EXPECT_EQ(retiled.error().message, "position 1, counted from 0, is not on the surface");
    }
}

TEST(Retile, StopsWhenCancelled) {
    const std::atomic<bool> now = true;
    const SurfaceMesh mesh = test::sphere(8);
    const Result<Retiled> retiled = retile(mesh, scatter(mesh, 100, 1), now);
    ASSERT_FALSE(retiled);
    EXPECT_EQ(retiled.error().message, "re-tiling the surface was stopped");
}

}  // namespace
}  // namespace cascade
