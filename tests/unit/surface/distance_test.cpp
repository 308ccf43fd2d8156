// Distances along surfaces, compared with formulas and with refined meshes, and the place on a
// surface that is nearest to a point.
#include "surface/distance.h"
#include "surface/nearest_place.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cascade::test {
namespace {

SurfacePlace nearest(const SurfaceMesh& mesh, Vector3d point) {
    return NearestPlace(mesh).find(point).value();
}

TEST(Refinement, KeepsTheSurfaceAndItsPlaces) {
    for (const SurfaceMesh& mesh : {box(), square(), torus(9, 6, 2, 0.7), sphere(3)}) {
        const Refinement refinement(mesh, 0.11, 100'000, never);
        const SurfaceMesh& fine = refinement.mesh();
        expect_manifold(fine);
        EXPECT_NEAR(fine.total_area() / mesh.total_area(), 1, 1e-12);
        EXPECT_EQ(facts_of(fine).euler_characteristic, facts_of(mesh).euler_characteristic);
        EXPECT_TRUE(std::equal(mesh.points.begin(), mesh.points.end(), fine.points.begin()));
        for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_LE(length(fine.corner(t, (k + 1) % 3) - fine.corner(t, k)), 0.11);
            }
        }
        for (const SurfacePlace& place : scatter(mesh, 500, 4)) {
            const SurfacePlace found = refinement.refined(place);
            EXPECT_LT(length(position_of(fine, found) - position_of(mesh, place)), 1e-12);
            for (const double weight : found.weights) EXPECT_GE(weight, 0);
        }
    }
}

TEST(Distance, WithinReachIsThatOfTheWholeSurface) {
    for (const SurfaceMesh& mesh : {box(), torus(9, 6, 2, 0.7), sphere(3)}) {
        const auto prepared = std::make_shared<const DistanceMesh>(mesh, never);
        for (const SurfacePlace& source : scatter(mesh, 5, 8)) {
            const SurfaceDistance whole(mesh, std::span(&source, 1), never);
            for (const double reach : {0.05, 0.3, 0.9}) {
                const SurfaceDistance part(prepared, std::span(&source, 1), never, reach);
                for (const SurfacePlace& place : scatter(mesh, 500, 4)) {
                    const double far = whole.at(place).distance, found = part.at(place).distance;
                    if (far <= reach) EXPECT_EQ(found, far);
                    else EXPECT_GT(found, reach);
                }
            }
        }
    }
}

TEST(Refinement, StopsAfterSoManyCuts) {
    const Refinement refinement(square(), 1e-9, 100, never);
    EXPECT_EQ(refinement.mesh().points.size(), 104u);
}

TEST(NearestPlace, IsThatOfATryOfAllTriangles) {
    const SurfaceMesh mesh = torus(24, 12, 2, 0.7);
    const NearestPlace nearest_place(mesh);
    for (int k = 0; k < 400; ++k) {
        const Vector3d point = {3 * std::sin(k * 1.7), 3 * std::cos(k * 2.3), std::sin(k * 0.9)};
        const SurfacePlace found = nearest_place.find(point).value();
        double best = 1e9;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const SurfacePlace place = {
                t,
                nearest_weights({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, point)};
            best = std::min(best, length(position_of(mesh, place) - point));
        }
        EXPECT_EQ(length(position_of(mesh, found) - point), best);
        const double to_ring = std::hypot(std::hypot(point.x, point.y) - 2, point.z);
        EXPECT_NEAR(best, std::abs(to_ring - 0.7), 0.05);
    }
}

TEST(NearestPlace, OfATriangleIsInsideOnAnEdgeOrAtACorner) {
    const std::array<Vector3d, 3> corners = {Vector3d{0, 0, 0}, Vector3d{2, 0, 0},
                                             Vector3d{0, 2, 0}};
    using Weights = std::array<double, 3>;
    EXPECT_EQ(nearest_weights(corners, {0.5, 0.5, 7}), (Weights{0.5, 0.25, 0.25}));
    EXPECT_EQ(nearest_weights(corners, {1, -3, 1}), (Weights{0.5, 0.5, 0}));
    EXPECT_EQ(nearest_weights(corners, {3, 3, 1}), (Weights{0, 0.5, 0.5}));
    EXPECT_EQ(nearest_weights(corners, {-1, -1, 0}), (Weights{1, 0, 0}));
    const std::array<Vector3d, 3> line = {Vector3d{0, 0, 0}, Vector3d{2, 0, 0}, Vector3d{4, 0, 0}};
    EXPECT_EQ(nearest_weights(line, {1, 5, 0}), (Weights{0.5, 0.5, 0}));
}

TEST(NearestPlace, IsFoundFromAnywhereOrNotAtAll) {
    const SurfaceMesh mesh = box();
    const NearestPlace nearest_place(mesh);
    const auto found = [&](Vector3d p) { return position_of(mesh, nearest_place.find(p).value()); };
    for (const double far : {3.0, 1e9, 1e160, 1.7e308}) {
        EXPECT_LT(length(found({far, 0.5, 0.5}) - Vector3d{1, 0.5, 0.5}), far < 4 ? 1e-12 : 0.71);
        EXPECT_EQ(found({far, 0.5, 0.5}).x, 1);
        EXPECT_EQ(found({-far, far, far}), (Vector3d{0, 1, 1}));
    }
    EXPECT_FALSE(nearest_place.find({NAN, 0, 0}));
    EXPECT_FALSE(nearest_place.find({0, INFINITY, 0}));
    const SurfaceMesh empty;
    EXPECT_FALSE(NearestPlace(empty).find({0, 0, 0}));
}

TEST(Distance, IsExactOnAPlane) {
    const Vector3d e = unit(Vector3d{1, 2, -1}), f = unit(cross(e, Vector3d{0.3, 1, 1}));
    const SurfaceMesh mesh = sheet(13, 9, [&](double u, double v) {
        return e * (u + 0.1 * std::sin(9 * v)) + f * (v + 0.1 * std::sin(7 * u));
    });
    for (const std::size_t triangles : {1u, 5'000u}) {
        // With one source, a straight line that stays inside the plane is the shortest way.
        const SurfacePlace source = nearest(mesh, e * 0.52 + f * 0.5);
        const SurfaceDistance distance(mesh, std::span(&source, 1), never, {triangles});
        const Vector3d from = position_of(mesh, source);
        int counted = 0;
        for (const SurfacePlace& place : scatter(mesh, 500, 2)) {
            const Vector3d apart = position_of(mesh, place) - from;
            if (length(apart) > 0.35) continue;
            ++counted;
            EXPECT_NEAR(distance.at(place).distance, length(apart), 1e-9);
        }
        EXPECT_GT(counted, 100);
    }
}

/// The distance along a cube from the middle of its lower side to p, by unfolding the cube.
double from_below_the_cube(Vector3d p) {
    double best = 1e9;
    for (int side = 0; side < 8; ++side) {
        double x = side & 1 ? 1 - p.x : p.x, y = side & 2 ? 1 - p.y : p.y;
        if (side & 4) std::swap(x, y);
        if (p.z < 1e-9) best = std::min(best, std::hypot(x - 0.5, y - 0.5));
        if (p.z > 1 - 1e-9) {
            best = std::min({best, std::hypot(2.5 - x, y - 0.5), std::hypot(1.5 - x, 2.5 - y)});
        }
        if (x > 1 - 1e-9) {
            // The way goes straight up, or over the wall beside it and around the corner.
            best = std::min({best, std::hypot(0.5 + p.z, y - 0.5), std::hypot(1.5 - y, 0.5 + p.z)});
        }
    }
    return best;
}

TEST(Distance, GoesAroundACube) {
    const SurfaceMesh mesh = box();
    const SurfacePlace source = nearest(mesh, {0.5, 0.5, -1});
    const SurfaceDistance distance(mesh, std::span(&source, 1), never);
    for (const SurfacePlace& place : scatter(mesh, 3000, 3)) {
        const Vector3d p = position_of(mesh, place);
        EXPECT_NEAR(distance.at(place).distance, from_below_the_cube(p), 2e-3)
            << p.x << ' ' << p.y << ' ' << p.z;
    }
    EXPECT_NEAR(distance.at(nearest(mesh, {0.5, 0.5, 2})).distance, 2, 1e-9);
}

TEST(Distance, OnASphereIsOfFirstOrder) {
    std::vector<double> means;
    for (const int n : {16, 32, 64}) {
        const SurfaceMesh mesh = sphere(n);
        const SurfacePlace source = {5, {0.2, 0.3, 0.5}};
        const SurfaceDistance distance(mesh, std::span(&source, 1), never, {1});
        const Vector3d from = unit(position_of(mesh, source));
        double sum = 0;
        for (std::uint32_t k = 0; k < mesh.points.size(); ++k) {
            const double exact = std::acos(std::clamp(dot(from, mesh.points[k]), -1.0, 1.0));
            const double error = std::abs(distance.at_point(k).distance - exact);
            sum += error;
            EXPECT_LT(error, 1.2 / n + 0.005);
        }
        means.push_back(sum / static_cast<double>(mesh.points.size()));
        RecordProperty("mean_" + std::to_string(n), std::to_string(means.back()));
    }
    EXPECT_LT(means[2], 0.0025);
    EXPECT_LT(means[1], means[0] / 1.8);
    EXPECT_LT(means[2], means[1] / 1.8);
}

TEST(Distance, SeveralSourcesShareTheSurface) {
    const SurfaceMesh mesh = sheet(20, 20, [](double u, double v) { return Vector3d{u, v, 0}; });
    const std::vector<SurfacePlace> sources = {nearest(mesh, {0.21, 0.33, 0}),
                                               nearest(mesh, {0.8, 0.4, 0}),
                                               nearest(mesh, {0.5, 0.91, 0})};
    const SurfaceDistance distance(mesh, sources, never);
    for (const SurfacePlace& place : scatter(mesh, 2000, 5)) {
        std::vector<double> exact;
        for (const SurfacePlace& source : sources) {
            exact.push_back(length(position_of(mesh, place) - position_of(mesh, source)));
        }
        const SurfaceDistance::Reach reach = distance.at(place);
        const auto best = std::min_element(exact.begin(), exact.end());
        EXPECT_NEAR(reach.distance, *best, 0.004);
        EXPECT_LT(exact[reach.source], *best + 0.02);
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(distance.at(sources[k]).distance, 0, 1e-15);
        EXPECT_EQ(distance.at(sources[k]).source, k);
    }
}

TEST(Distance, OtherPiecesAreInfinitelyFar) {
    PolygonSoup soup = cube();
    append(soup, cube(), {5, 0, 0});
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const SurfacePlace source = nearest(mesh, {0, 0.5, 0.5});
    const SurfaceDistance distance(mesh, std::span(&source, 1), never);
    for (std::uint32_t k = 0; k < mesh.points.size(); ++k) {
        EXPECT_EQ(std::isfinite(distance.at_point(k).distance), mesh.points[k].x < 3);
    }
    const auto away = distance.at(nearest(mesh, {9, 0, 0}));
    EXPECT_TRUE(std::isinf(away.distance));
    EXPECT_EQ(away.source, SurfaceDistance::no_source);
    const SurfaceDistance none(mesh, {}, never);
    EXPECT_TRUE(std::isinf(none.at_point(0).distance));
}

/// The shortest way around a hole goes through the hole's corners.
TEST(Distance, GoesAroundAHole) {
    // A ring around a square hole, 1 to 3 wide. The hole interrupts straight lines.
    const SurfaceMesh mesh =
        make_mesh(soup_of({{0, 0, 0},
                           {6, 0, 0},
                           {6, 6, 0},
                           {0, 6, 0},
                           {2, 2, 0},
                           {4, 2, 0},
                           {4, 4, 0},
                           {2, 4, 0}},
                          {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}))
            ->mesh;
    const SurfacePlace source = nearest(mesh, {1, 3, 0});
    const SurfaceDistance distance(mesh, std::span(&source, 1), never);
    EXPECT_NEAR(distance.at(nearest(mesh, {5, 3, 0})).distance, 2 * std::sqrt(2.0) + 2, 0.01);
    EXPECT_NEAR(distance.at(nearest(mesh, {3, 1, 0})).distance, std::sqrt(8.0), 0.005);
}

TEST(Distance, BadTrianglesOnlyTakeLonger) {
    // Sheared columns from very thin to wide, with angles of nearly 0 and nearly 180 degrees.
    const SurfaceMesh mesh = sheet(40, 6, [](double u, double v) {
        return Vector3d{std::pow(u, 6.0) + 3 * v, v, 0};
    });
    const SurfacePlace source = nearest(mesh, {1.5, 0.5, 0});
    const SurfaceDistance distance(mesh, std::span(&source, 1), never, {1});
    const Vector3d from = position_of(mesh, source);
    for (std::uint32_t k = 0; k < mesh.points.size(); ++k) {
        const double straight = length(mesh.points[k] - from),
                     found = distance.at_point(k).distance;
        EXPECT_GE(found, straight * (1 - 1e-6));
        EXPECT_LT(found, straight * 1.05 + 1e-9);
    }
}

}  // namespace
}  // namespace cascade::test
