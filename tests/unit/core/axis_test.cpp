// The turn that brings an axis of space upright.
#include "core/axis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cascade {
namespace {

TEST(Axis, HasANameAndIsFoundByIt) {
    for (const Axis axis : {Axis::x, Axis::y, Axis::z})
        EXPECT_EQ(axis_of_name(name_of(axis)), axis);
    for (const char* wrong : {"", "w", "X", "xy", "-z"}) EXPECT_FALSE(axis_of_name(wrong)) << wrong;
}

TEST(Axis, TurnsUprightAndBackWithoutLosingABit) {
    const Vector3d v{0.1, -0.0, 3e-300};
    for (const Axis up : {Axis::x, Axis::y, Axis::z}) {
        const Vector3d back = turned_from_upright(turned_upright(v, up), up);
        EXPECT_EQ(back, v);
        EXPECT_TRUE(std::signbit(back.y)) << name_of(up);
    }
}

TEST(Axis, TheTurnBringsUpToYAndIsNoMirror) {
    EXPECT_EQ(turned_upright(Vector3d{1, 0, 0}, Axis::x), (Vector3d{0, 1, 0}));
    EXPECT_EQ(turned_upright(Vector3d{0, 1, 0}, Axis::y), (Vector3d{0, 1, 0}));
    EXPECT_EQ(turned_upright(Vector3d{0, 0, 1}, Axis::z), (Vector3d{0, 1, 0}));
    const Vector3d a{1, 2, 3}, b{-4, 0.5, 7};
    for (const Axis up : {Axis::x, Axis::y, Axis::z}) {
        EXPECT_EQ(cross(turned_upright(a, up), turned_upright(b, up)),
                  turned_upright(cross(a, b), up))
            << name_of(up);
    }
}

TEST(Axis, WhatLooksAlongMinusYWhileZIsUpwardsLooksAlongZ) {
    EXPECT_EQ(turned_upright(Vector3d{0, -1, 0}, Axis::z), (Vector3d{0, 0, 1}));
}

}  // namespace
}  // namespace cascade
