// Placements as maps of space, and their quaternions.
#include "mesh/instances.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cascade {
namespace {

void expect_near(Vector3d a, Vector3d b, double tolerance = 1e-12) {
    EXPECT_LT(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Quaternions, TurnTheAxesToAFrame) {
    // Rotations in which each component of the quaternion is the largest.
    for (int k = 0; k < 200; ++k) {
        const Vector3d x = unit(Vector3d{std::sin(1.0 + k), std::sin(2.3 * k), std::cos(1.7 * k)});
        const Vector3d y = unit(cross(Vector3d{std::cos(0.9 * k), 0.4, std::sin(3.1 * k)}, x));
        const Quaternion q = quaternion_of(x, y, cross(x, y));
        EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1, 1e-14);
        expect_near(turned(q, {1, 0, 0}), x);
        expect_near(turned(q, {0, 1, 0}), y);
        expect_near(turned(q, {0, 0, 1}), cross(x, y));
    }
    const Quaternion half_turn = quaternion_of({-1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    EXPECT_EQ(half_turn, (Quaternion{0, 0, 1, 0}));
}

Placement slanted() {
    Placement placement;
    placement.place = {1, 2, 3};
    placement.turn = quaternion_of(unit(Vector3d{1, 1, 0}), unit(Vector3d{-1, 1, 0}), {0, 0, 1});
    placement.scale = {2, 0.5, 3};
    return placement;
}

TEST(Placements, ScaleTurnAndMove) {
    const PlacementMap map(slanted());
    const float slope = std::sqrt(0.5F);
    EXPECT_LT(length(map.point({1, 0, 0}) - Vector3{1 + 2 * slope, 2 + 2 * slope, 3}), 1e-6F);
    EXPECT_LT(length(map.point({0, 2, 1}) - Vector3{1 - slope, 2 + slope, 6}), 1e-6F);
}

TEST(Placements, NormalsStayAcrossTheirPlane) {
    const PlacementMap map(slanted());
    const Vector3 a{1, 0.3F, -0.2F}, b{0.1F, -1, 0.7F}, origin;
    const Vector3 wanted =
        unit(cross(map.point(a) - map.point(origin), map.point(b) - map.point(origin)));
    EXPECT_LT(length(map.normal(unit(cross(a, b))) - wanted), 1e-6F);
}

TEST(Placements, MoveTogether) {
    Instances instances;
    instances.meshes.resize(1);
    instances.meshes[0].triangles.resize(7);
    instances.placements = {slanted(), slanted()};
    EXPECT_EQ(instances.triangle_count(), 14u);
    move_instances(instances, {1, 1, 1}, 10);
    expect_near(instances.placements[1].place, {0, 10, 20});
    expect_near(instances.placements[1].scale, {20, 5, 30});
}

}  // namespace
}  // namespace cascade
