// The rotation that makes a model stand upright and look along z.
#include "core/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cascade {
namespace {

constexpr std::array axes = {Axis::x, Axis::y, Axis::z};

/// All 12 combinations of `up` and `facing`.
std::vector<Stance> all_stances() {
    std::vector<Stance> stances;
    for (const Axis up : axes) {
        for (const Axis facing : axes) {
            if (facing == up) continue;
            for (const bool is_backwards : {false, true}) {
                stances.push_back({up, {facing, is_backwards}});
            }
        }
    }
    return stances;
}

Vector3d along(Heading heading) {
    const double sign = heading.is_backwards ? -1 : 1;
    return {heading.axis == Axis::x ? sign : 0, heading.axis == Axis::y ? sign : 0,
            heading.axis == Axis::z ? sign : 0};
}

TEST(Axis, HasANameAndIsFoundByIt) {
    for (const Axis axis : axes) EXPECT_EQ(axis_of_name(name_of(axis)), axis);
    for (const char* wrong : {"", "w", "X", "xy", "-z"}) EXPECT_FALSE(axis_of_name(wrong)) << wrong;
    for (const Stance& stance : all_stances()) {
        EXPECT_EQ(heading_of_name(name_of(stance.facing)), stance.facing);
    }
    EXPECT_EQ(name_of(Heading{Axis::z, true}), "-z");
    for (const char* wrong : {"", "-", "+x", "--x", "-w"})
        EXPECT_FALSE(heading_of_name(wrong)) << wrong;
}

TEST(Stances, TurnUprightAndBackWithoutLosingABit) {
    const Vector3d v{0.1, -0.0, 3e-300};
    for (const Stance& stance : all_stances()) {
        const Vector3d back = turned_from_upright(turned_upright(v, stance), stance);
        EXPECT_EQ(back, v);
        EXPECT_TRUE(std::signbit(back.y)) << name_of(stance.up) << name_of(stance.facing);
    }
}

TEST(Stances, BringUpToYAndTheFaceToZWithoutAMirror) {
    const Vector3d a{1, 2, 3}, b{-4, 0.5, 7};
    for (const Stance& stance : all_stances()) {
        EXPECT_EQ(turned_upright(along({stance.up}), stance), (Vector3d{0, 1, 0}));
        EXPECT_EQ(turned_upright(along(stance.facing), stance), (Vector3d{0, 0, 1}));
        EXPECT_EQ(cross(turned_upright(a, stance), turned_upright(b, stance)),
                  turned_upright(cross(a, b), stance))
            << name_of(stance.up) << name_of(stance.facing);
    }
}

TEST(Stances, AreThoseOfOtherProgramsWhereNothingIsSaid) {
    const Vector3d v{1, 2, 3};
    EXPECT_EQ(turned_upright(v, usual_stance(Axis::x)), (Vector3d{3, 1, 2}));
    EXPECT_EQ(turned_upright(v, usual_stance(Axis::y)), v);
    EXPECT_EQ(turned_upright(v, usual_stance(Axis::z)), (Vector3d{1, 3, -2}));
    EXPECT_EQ(usual_stance(Axis::y), Stance());
}

}  // namespace
}  // namespace cascade
