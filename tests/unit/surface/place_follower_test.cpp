// Places found from triangle to triangle against those found among all triangles.
#include "surface/place_follower.h"

#include "mesh/edge_pairs.h"
#include "mesh/shapes.h"
#include "tests/support/random_stream.h"

#include <gtest/gtest.h>

namespace cascade::testing {
namespace {

Vector3d random_step(RandomStream& random, double length) {
    return Vector3d{random.symmetric(), random.symmetric(), random.symmetric()} * length;
}

/// Walks at random and compares. `rise`: how far points leave the surface.
void expect_nearest_places(const SurfaceMesh& mesh, double step, double rise) {
    const PlaceFollower follower(mesh);
    const NearestPlace all(mesh);
    RandomStream random(7);
    std::uint32_t triangle = 0;
    Vector3d on_surface = mesh.corner(0, 0);
    for (int k = 0; k < 20000; ++k) {
        const Vector3d point = on_surface + random_step(random, step);
        const auto found = follower.find(point, triangle);
        ASSERT_TRUE(found);
        const auto expected = all.find(point);
        EXPECT_EQ(found->place.triangle, expected->triangle);
        EXPECT_EQ(found->place.weights, expected->weights);
        EXPECT_EQ(found->position, position_of(mesh, *expected));
        triangle = found->place.triangle;
        on_surface = found->position + random_step(random, rise);
    }
}

TEST(PlaceFollower, FindsTheNearestPlacesOfATorus) {
    const SurfaceMesh mesh = *torus_mesh(1, 0.42, 0.1);
    expect_nearest_places(mesh, 0.02, 0);
    expect_nearest_places(mesh, 0.1, 0.05);
}

TEST(PlaceFollower, FindsTheNearestPlacesAtSharpEdges) {
    expect_nearest_places(*box_mesh({1, 2, 1}, 0.2), 0.1, 0);
}

/// Beyond the boundary the nearest place is on it.
TEST(PlaceFollower, FindsTheNearestPlacesOfASheet) {
    const SurfaceMesh mesh =
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 3}}});
    expect_nearest_places(mesh, 0.4, 0.1);
    const PlaceFollower follower(mesh);
    const auto beside = follower.find({1.5, 0.5, 0.25}, 1);
    EXPECT_TRUE(beside->is_border);
    EXPECT_EQ(beside->position, (Vector3d{1, 0.5, 0}));
    EXPECT_TRUE(follower.find({-1, -1, 0}, 0)->is_border);
    EXPECT_FALSE(follower.find({0.5, 0.5, 0.25}, 0)->is_border);
}

TEST(PlaceFollower, TakesAnyTriangleToBeginWith) {
    const SurfaceMesh mesh = *sphere_mesh(1, 0.05);
    const PlaceFollower follower(mesh);
    const NearestPlace all(mesh);
    RandomStream random(3);
    for (int k = 0; k < 1000; ++k) {
        const Vector3d point = random_step(random, 2);
        const auto any = static_cast<std::uint32_t>(random.next());
        for (const std::uint32_t from : {any, TriangleEdge::none}) {
            EXPECT_EQ(follower.find(point, from)->place.triangle, all.find(point)->triangle);
        }
    }
    EXPECT_FALSE(follower.find({NAN, 0, 0}, 0));
}

/// A cell that is on one sheet stays there when another one is near.
TEST(PlaceFollower, StaysOnItsSheet) {
    SurfaceMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                               {{{0, 1, 2}}, {{3, 4, 5}}});
    const PlaceFollower follower(mesh);
    EXPECT_EQ(follower.find({0.2, 0.2, 0.6}, 0)->place.triangle, 0U);
    EXPECT_EQ(follower.find({0.2, 0.2, 0.6}, TriangleEdge::none)->place.triangle, 1U);
}

}  // namespace
}  // namespace cascade::testing
