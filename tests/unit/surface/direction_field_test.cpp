// Directions along surfaces that follow axes, gradients, curvature or given directions (keys).
#include "mesh/shapes.h"
#include "surface/key_directions.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cascade::test {
namespace {

using std::numbers::pi;

void expect_tangents(const TangentPlanes& planes, const std::vector<Vector3d>& field) {
    ASSERT_EQ(field.size(), planes.size());
    for (std::size_t k = 0; k < field.size(); ++k) {
        EXPECT_NEAR(length(field[k]), 1, 1e-9);
        EXPECT_NEAR(dot(field[k], planes.frames[k].normal), 0, 1e-9);
    }
}

Vector3d around_z(Vector3d p) { return unit(Vector3d{-p.y, p.x, 0}); }

/// The largest angle between directions of neighbours, in degrees, after carrying one to the
/// other's plane.
double worst_jump(const TangentPlanes& planes, const std::vector<Vector3d>& field,
                  DirectionKind kind) {
    double worst = 0;
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const Vector2d here = planes.frames[k].in_plane(field[k]);
        for (const TangentLink& link : planes.links_of(k)) {
            const Vector2d there = planes.frames[link.neighbour].in_plane(field[link.neighbour]);
            double apart = std::remainder(
                std::atan2(there.y, there.x) + link.turn - std::atan2(here.y, here.x), 2 * pi);
            if (kind == DirectionKind::lines) apart = std::remainder(apart, pi);
            worst = std::max(worst, std::abs(apart) * 180 / pi);
        }
    }
    return worst;
}

TEST(TangentPlanes, TurnsAreOppositeAndLeadAroundPointsByTheirDefects) {
    const SurfaceMesh mesh = torus(20, 12, 2, 0.8);
    const TangentPlanes planes = planes_of_triangles(mesh);
    for (std::uint32_t k = 0; k < planes.size(); ++k) {
        for (const TangentLink& link : planes.links_of(k)) {
            for (const TangentLink& back : planes.links_of(link.neighbour)) {
                if (back.neighbour != k) continue;
                EXPECT_EQ(back.turn, -link.turn);
                EXPECT_DOUBLE_EQ(back.weight, link.weight);
                EXPECT_GT(link.distance, 0);
            }
        }
    }
    // Around a corner of a cube, on which three right angles meet, a direction turns by 90 degrees.
    const SurfaceMesh cube = box();
    const TangentPlanes sides = planes_of_triangles(cube);
    const std::uint32_t corner = cube.triangles[0][0];
    double turned = 0;
    std::uint32_t at = 0;
    do {
        std::uint32_t k = 0;
        while (cube.triangles[at][k] != corner) ++k;
        const std::uint32_t next = cube.across[at][k].triangle;
        for (const TangentLink& link : sides.links_of(at)) {
            if (link.neighbour == next) turned += link.turn;
        }
        at = next;
    } while (at != 0);
    EXPECT_NEAR(std::abs(std::remainder(turned, 2 * pi)), pi / 2, 1e-9);
}

TEST(Directions, OfAnAxisOnASphereAreMeridians) {
    const SurfaceMesh mesh = sphere(24);
    const TangentPlanes planes = planes_of_triangles(mesh);
    const std::vector<Vector3d> field =
        axis_directions(planes, {0, 0, 1e200}, DirectionKind::arrows);
    expect_tangents(planes, field);
    for (std::size_t k = 0; k < field.size(); ++k) {
        const Vector3d p = unit(position_of(mesh, planes.places[k]));
        if (std::abs(p.z) > 0.95) continue;
        EXPECT_GT(dot(field[k], unit(Vector3d{0, 0, 1} - p * p.z)), 0.98);
    }
}

TEST(Directions, AreFilledWhereTheAxisStandsUpright) {
    // On the top and bottom of a cube the z axis gives no direction, so the walls around decide.
    SurfaceMesh mesh = box_mesh({1, 1, 1}, 0.05).value();
    for (Vector3d& p : mesh.points) p = p + Vector3d{0.5, 0.5, 0.5};
    for (const DirectionKind kind : {DirectionKind::arrows, DirectionKind::lines}) {
        const TangentPlanes planes = planes_of_triangles(mesh);
        const std::vector<Vector3d> field = axis_directions(planes, {0, 0, 2}, kind);
        expect_tangents(planes, field);
        for (std::size_t k = 0; k < field.size(); ++k) {
            const Vector3d p = position_of(mesh, planes.places[k]);
            if (std::abs(planes.frames[k].normal.z) < 0.5) {
                EXPECT_NEAR(std::abs(field[k].z), 1, 1e-12);
            } else if (p.x < 0.1 && p.y > 0.3 && p.y < 0.7) {
                EXPECT_GT(std::abs(field[k].x), 0.9);  // The direction of the wall beside it.
            }
        }
    }
    // A plate at a right angle to the axis still gets a single direction everywhere.
    const SurfaceMesh plate = sheet(9, 7, [](double u, double v) { return Vector3d{u, v, 0}; });
    const TangentPlanes planes = planes_of_triangles(plate);
    const std::vector<Vector3d> field = axis_directions(planes, {0, 0, 1}, DirectionKind::arrows);
    expect_tangents(planes, field);
    for (const Vector3d& v : field) EXPECT_LT(length(v - field[0]), 1e-9);
}

TEST(Directions, OfGradientsPointUphill) {
    const SurfaceMesh mesh = cylinder(40, 20, 0.5, 2);
    std::vector<double> heights;
    for (const Vector3d& p : mesh.points) heights.push_back(3 * p.z);
    const TangentPlanes planes = planes_of_triangles(mesh);
    const std::vector<Vector3d> uphill = gradients_of_points(mesh, planes, heights);
    for (const Vector3d& v : uphill) EXPECT_LT(length(v - Vector3d{0, 0, 3}), 1e-9);
    for (const Vector3d& v : directions(planes, uphill, DirectionKind::arrows)) {
        EXPECT_LT(length(v - Vector3d{0, 0, 1}), 1e-6);
    }
}

TEST(Directions, OfCurvatureOnACylinderAndATorus) {
    const SurfaceMesh pipe = cylinder(60, 30, 0.5, 2), ring = torus(80, 40, 2, 0.7);
    for (const SurfaceMesh* mesh : {&pipe, &ring}) {
        const PrincipalCurvatures curvature = principal_curvatures(*mesh);
        const TangentPlanes planes = planes_of_triangles(*mesh);
        const auto high =
            directions(planes, curvature_lines(*mesh, planes, curvature, Principal::high),
                       DirectionKind::lines);
        const auto low =
            directions(planes, curvature_lines(*mesh, planes, curvature, Principal::low),
                       DirectionKind::lines);
        expect_tangents(planes, high);
        for (std::size_t k = 0; k < planes.size(); ++k) {
            const Vector3d p = position_of(*mesh, planes.places[k]);
            if (mesh == &pipe && (p.z < 0.1 || p.z > 1.9)) continue;
            EXPECT_NEAR(dot(high[k], low[k]), 0, 1e-9);
            const Vector3d bent = mesh == &pipe ? high[k] : low[k];
            EXPECT_GT(std::abs(dot(bent, around_z(p))), 0.99);
        }
    }
    // A sphere has no lines of curvature, so its directions come from the frame of one tangent
    // plane.
    const SurfaceMesh ball = sphere(12);
    const TangentPlanes planes = planes_of_triangles(ball);
    const auto lines = curvature_lines(ball, planes, principal_curvatures(ball), Principal::high);
    for (const Vector3d& v : lines) EXPECT_EQ(length(v), 0);
    expect_tangents(planes, directions(planes, lines, DirectionKind::lines));
}

TEST(KeyDirections, AreCarriedAroundACylinder) {
    const SurfaceMesh mesh = cylinder(48, 24, 0.5, 2);
    const KeyDirection key = {{0.6, 0, 1},
                              {5, 1, 1}};  // Projected to the surface, this is at 45 degrees.
    const TangentPlanes planes = planes_of_triangles(mesh);
    const std::vector<Vector3d> field =
        key_directions(mesh, planes, std::span(&key, 1), DirectionKind::arrows, never);
    expect_tangents(planes, field);
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const Vector3d wanted =
            unit(around_z(position_of(mesh, planes.places[k])) + Vector3d{0, 0, 1});
        EXPECT_GT(dot(field[k], wanted), 0.98);
    }
}

TEST(KeyDirections, SmoothingTurnsFromOneKeyToTheNext) {
    const SurfaceMesh mesh = sheet(100, 20, [](double u, double v) {
        return Vector3d{5 * u, v, 0};
    });
    const TangentPlanes planes = planes_of_triangles(mesh);
    const std::vector<KeyDirection> keys = {{{0.5, 0.5, 0}, {1, 0, 0}}, {{4.5, 0.5, 0}, {0, 1, 0}}};
    const auto sharp = key_directions(mesh, planes, keys, DirectionKind::arrows, never);
    Team one(1), three(3);
    const auto soft = smoothed_directions(planes, sharp, DirectionKind::arrows, 0.7, three, never);
    expect_tangents(planes, soft);
    EXPECT_EQ(soft, smoothed_directions(planes, sharp, DirectionKind::arrows, 0.7, one, never));
    EXPECT_NEAR(worst_jump(planes, sharp, DirectionKind::arrows), 90, 1e-3);
    EXPECT_LT(worst_jump(planes, soft, DirectionKind::arrows), 12);
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const Vector3d p = position_of(mesh, planes.places[k]);
        const double x = p.x;
        if (x < 0.5) {
            EXPECT_GT(soft[k].x, 0.99);
        }
        if (x > 4.5) {
            EXPECT_GT(soft[k].y, 0.99);
        }
        if (length(p - Vector3d{2.5, 0.5, 0}) < 0.1) {
            EXPECT_NEAR(soft[k].x, std::sqrt(0.5), 0.1);
        }
    }
    const auto same = smoothed_directions(planes, sharp, DirectionKind::arrows, 0, one, never);
    for (std::size_t k = 0; k < planes.size(); ++k) EXPECT_LT(length(same[k] - sharp[k]), 1e-9);
}

/// Opposite directions cancel or turn into each other if they are arrows. As lines they are equal.
TEST(KeyDirections, LinesDoNotKnowTheirSign) {
    const SurfaceMesh mesh = sheet(20, 20, [](double u, double v) { return Vector3d{u, v, 0}; });
    const TangentPlanes planes = planes_of_triangles(mesh);
    const std::vector<KeyDirection> keys = {{{0.1, 0.5, 0}, {1, 2, 0}},
                                            {{0.9, 0.5, 0}, {-1, -2, 0}}};
    const auto lines = key_directions(mesh, planes, keys, DirectionKind::lines, never);
    Team team(2);
    const auto soft = smoothed_directions(planes, lines, DirectionKind::lines, 0.3, team, never);
    for (const auto& field : {lines, soft}) {
        for (const Vector3d& v : field)
            EXPECT_NEAR(std::abs(dot(v, unit(Vector3d{1, 2, 0}))), 1, 1e-9);
    }
    const auto arrows = key_directions(mesh, planes, keys, DirectionKind::arrows, never);
    EXPECT_NEAR(worst_jump(planes, arrows, DirectionKind::arrows), 180, 1e-6);
}

TEST(KeyDirections, WhatSaysNothingIsLeftOut) {
    PolygonSoup soup = cube();
    append(soup, cube(), {5, 0, 0});
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const TangentPlanes planes = planes_of_triangles(mesh);
    const std::vector<KeyDirection> keys = {
        {{0.5, 0.5, 2}, {0, 0, 1}},  // At a right angle to the surface.
        {{0.5, 0.5, 2}, {0, 0, 0}},      {{0.5, 0.5, 2}, {NAN, 0, 0}}, {{NAN, 0.5, 2}, {1, 0, 0}},
        {{0.5, 0.5, 2}, {0, 1e-300, 0}}, {{0.5, 0.5, 2}, {1, 0, 0}}};  // The earlier key wins.
    const auto field = key_directions(mesh, planes, keys, DirectionKind::arrows, never);
    expect_tangents(planes, field);
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const Vector3d p = position_of(mesh, planes.places[k]);
        if (planes.frames[k].normal.z > 0.5 && p.x < 3) {
            EXPECT_NEAR(field[k].y, 1, 1e-9);
        }
    }
    expect_tangents(planes, key_directions(mesh, planes, {}, DirectionKind::lines, never));
}

TEST(Directions, OfAnythingAreFinite) {
    SurfaceMesh mesh = sphere(6);
    mesh.points[3] = mesh.points[mesh.triangles[0][1]];  // Triangles without area.
    const TangentPlanes planes = planes_of_triangles(mesh);
    std::vector<Vector3d> vectors(planes.size(), Vector3d{1e308, -1e308, 1e308});
    vectors[5] = {NAN, 0, 0};
    vectors[6] = {INFINITY, 0, 0};
    for (const DirectionKind kind : {DirectionKind::arrows, DirectionKind::lines}) {
        expect_tangents(planes, directions(planes, vectors, kind));
        Team team(2);
        expect_tangents(planes, smoothed_directions(planes, directions(planes, vectors, kind), kind,
                                                    10, team, never));
    }
}

}  // namespace
}  // namespace cascade::test
