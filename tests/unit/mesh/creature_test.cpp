// The animal is one closed piece that stands on the ground.
#include "mesh/creature.h"
#include "mesh/normals.h"

#include "unit/mesh/measures.h"

namespace cascade {
namespace {

const std::atomic<bool> go_on{false};

TEST(Creature, IsOneSmoothPieceAtAllResolutions) {
    for (const double edge : {0.06, 0.035}) {
        const auto made = creature_mesh(edge, go_on);
        ASSERT_TRUE(made) << made.error().message;
        test::expect_closed(*made);
        const MeshFacts facts = facts_of(*made);
        EXPECT_EQ(facts.components, 1u);
        EXPECT_EQ(facts.euler_characteristic, 2);
        EXPECT_GT(test::volume_of(*made), 0);
        EXPECT_GT(test::smallest_angle(*made), 15);
        EXPECT_EQ(facts.low.y, 0) << "it stands on the ground";
        EXPECT_NEAR(facts.high.y, 1.5, 0.05);
    }
}

TEST(Creature, IsNowhereThin) {
    const auto made = creature_mesh(0.03, go_on);
    ASSERT_TRUE(made);
    const std::vector<Vector3d> normals = point_normals(*made);
    // The function's own ground: the mesh was lifted onto y = 0.
    double lowest = 1;
    for (double y = -0.1; y < 0.1; y += 0.0005) {
        if (creature_function({0.136, y, 0.31}) > 0) lowest = std::min(lowest, y);
    }
    for (std::size_t k = 0; k < made->points.size(); ++k) {
        const Vector3d inside = made->points[k] + Vector3d{0, lowest, 0} - normals[k] * 0.045;
        EXPECT_GT(creature_function(inside), 0) << made->points[k].y << " " << made->points[k].z;
    }
}

TEST(Creature, StandsOnFourLegsAndLooksAlongZ) {
    const auto is_inside = [](double x, double y, double z) {
        return creature_function({x, y, z}) > 0;
    };
    // At half the height of the legs a slice has four parts, none in the middle.
    for (const double z : {0.28, -0.41}) {
        EXPECT_TRUE(is_inside(0.137, 0.2, z));
        EXPECT_TRUE(is_inside(-0.137, 0.2, z));
        EXPECT_FALSE(is_inside(0, 0.2, z));
    }
    EXPECT_FALSE(is_inside(0.137, 0.2, -0.05));
    // Snout in front, tail behind.
    EXPECT_TRUE(is_inside(0, 1.07, 0.8));
    EXPECT_TRUE(is_inside(0, 1.0, -0.79));
    EXPECT_FALSE(is_inside(0, 1.0, -0.2));
    for (const Vector3d p : {Vector3d{0.1, 0.3, 0.2}, {0.15, 1.4, 0.5}, {0.02, 1, 0.9}}) {
        EXPECT_NEAR(creature_function(p), creature_function({-p.x, p.y, p.z}), 1e-12);
    }
    EXPECT_TRUE(std::isfinite(creature_function({1e6, 1e6, -1e6})));
}

}  // namespace
}  // namespace cascade
