// The first cells are spread evenly where they are allowed, and face outwards.
#include "tissue/founders.h"

#include "mesh/shapes.h"
#include "tests/support/random_stream.h"

#include <cmath>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

TEST(Founders, AreSpreadByArea) {
    const SurfaceMesh mesh = *torus_mesh(0.35, 0.15, 0.03);
    const auto around = around_surface(mesh);
    constexpr std::size_t count = 20000;
    const auto founders = *random_founders(*around, count, 5, 0);
    ASSERT_EQ(founders.size(), count);
    std::size_t outside = 0, above = 0;
    for (const NearPlace& founder : founders) {
        EXPECT_NEAR(founder.off, 0, 1e-12);
        outside += std::hypot(founder.position.x, founder.position.z) > 0.35 ? 1 : 0;
        above += founder.position.y > 0 ? 1 : 0;
    }
    // The outer half of a torus has 1/2 + r/(π R) of its area.
    EXPECT_NEAR(static_cast<double>(outside) / count, 0.5 + 0.15 / (M_PI * 0.35), 0.01);
    EXPECT_NEAR(static_cast<double>(above) / count, 0.5, 0.01);
}

TEST(Founders, DependOnTheirNumberAlone) {
    const auto box = in_box({1, 0.5, 0}, {});
    const auto few = *random_founders(*box, 10, 5, 0), many = *random_founders(*box, 3000, 5, 0);
    const auto others = *random_founders(*box, 10, 6, 0), later = *random_founders(*box, 10, 5, 1);
    for (std::size_t k = 0; k < 10; ++k) {
        EXPECT_EQ(few[k].position, many[k].position);
        EXPECT_NE(few[k].position, others[k].position);
        EXPECT_NE(few[k].position, later[k].position);
    }
    double highest = 0;
    for (const NearPlace& founder : many) {
        EXPECT_EQ(founder.position.z, 0);
        EXPECT_LE(founder.position.y, 0.5);
        highest = std::max(highest, founder.position.x);
    }
    EXPECT_GT(highest, 0.99);
}

TEST(Founders, AreWhereTheirChanceIs) {
    const auto box = in_box({1, 1, 0}, {});
    const FounderChance chance = [](std::span<const NearPlace> places) {
        std::vector<double> chances;
        for (const NearPlace& place : places) {
            chances.push_back(place.position.x < 0.2 ? NAN : place.position.x);
        }
        return chances;
    };
    constexpr std::size_t count = 20000;
    double sum = 0;
    const auto founders = *random_founders(*box, count, 1, 0, chance);
    for (const NearPlace& founder : founders) {
        EXPECT_GE(founder.position.x, 0.2);
        sum += founder.position.x;
    }
    // The mean of x, weighted by a density that equals x from 0.2 to 1.
    EXPECT_NEAR(sum / count, (1 - 0.008) / 3 / ((1 - 0.04) / 2), 0.005);
}

TEST(Founders, AreRefusedWhereTheyHaveNoChance) {
    const auto none = random_founders(*in_box({1, 1, 0}, {}), 2, 1, 0, [](auto places) {
        return std::vector<double>(places.size(), 0);
    });
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message,
              "of 20480 random positions only 0 are accepted as founders of 2");
}

TEST(Founders, GivenByPlacesAreOnTheSurface) {
    const SurfaceMesh mesh = *sphere_mesh(0.5, 0.02);
    const auto around = around_surface(mesh);
    const std::vector<Vector3d> points{{2, 0, 0}, {0, 0.1, 0}};
    const auto founders = founders_at(*around, points);
    EXPECT_NEAR(founders[0].position.x, 0.5, 1e-3);
    EXPECT_NEAR(founders[1].position.y, 0.5, 1e-3);
    EXPECT_NEAR(founders[1].off, 0, 1e-12);
    const std::vector<Vector3d> beyond{{2, -1, 3}};
    EXPECT_EQ(founders_at(*in_box({1, 1, 0}, {}), beyond)[0].position, (Vector3d{1, 0, 0}));
}

Vector3d rotated(const std::array<double, 4>& q, Vector3d v) {
    const Vector3d u{q[1], q[2], q[3]};
    return v + cross(u, cross(u, v) + v * q[0]) * 2;
}

TEST(Founders, FaceTheWayTheyAreTold) {
    RandomStream random(4);
    const auto vector = [&] {
        return Vector3d{random.symmetric(), random.symmetric(), random.symmetric()};
    };
    for (int k = 0; k < 1000; ++k) {
        const Vector3d ey = vector(), ez = vector();
        const auto q = rotation_to(ey, ez);
        EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
        EXPECT_LT(length(rotated(q, {0, 1, 0}) - unit(ey)), 1e-9);
        const Vector3d z = rotated(q, {0, 0, 1});
        EXPECT_GT(dot(z, ez), 0);
        EXPECT_NEAR(dot(z, cross(ey, ez)), 0, 1e-9);
    }
    for (const Vector3d ey : {Vector3d{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -2}}) {
        for (const Vector3d ez : {Vector3d{}, ey, {NAN, 0, 0}}) {
            EXPECT_LT(length(rotated(rotation_to(ey, ez), {0, 1, 0}) - unit(ey)), 1e-12);
        }
    }
}

}  // namespace
}  // namespace cascade::test
