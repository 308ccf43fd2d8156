// Nearest places, found by going from triangle to triangle, compared with a search of all
// triangles.
#include "surface/place_follower.h"

#include "mesh/edge_pairs.h"
#include "mesh/shapes.h"
#include "tests/support/random_stream.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

Vector3d random_step(RandomStream& random, double length) {
    return Vector3d{random.symmetric(), random.symmetric(), random.symmetric()} * length;
}

/// Follows a random walk and compares at each step. `rise` is how far points may be from the
/// surface.
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
        if (const auto over = follower.stay(point, triangle)) {
            EXPECT_EQ(found->place.triangle, over->triangle);
            EXPECT_EQ(found->place.weights, over->weights);
            EXPECT_EQ(found->position, point - over->normal * over->height);
        }
        const auto expected = all.find(point);
        EXPECT_EQ(found->place.triangle, expected->triangle);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            EXPECT_NEAR(found->place.weights[corner], expected->weights[corner], 1e-12);
        }
        EXPECT_LT(length(found->position - position_of(mesh, *expected)), 1e-13);
        EXPECT_NEAR(found->distance, length(point - found->position), 1e-13);
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

/// The surface has slivers at all angles which share corners, and points are far away from it.
TEST(PlaceFollower, FindsTheNearestPlacesOfARoughSurface) {
    SurfaceMesh mesh = *sphere_mesh(1, 0.3);
    RandomStream random(11);
    for (Vector3d& point : mesh.points) point = point + random_step(random, 0.05);
    expect_nearest_places(mesh, 0.05, 0.02);
}

/// Finds the same place to the last bit, whatever place the search begins at.
TEST(PlaceFollower, FindsPlacesThatDoNotDependOnTheWay) {
    const SurfaceMesh mesh = *torus_mesh(1, 0.42, 0.1);
    const PlaceFollower follower(mesh);
    RandomStream random(5);
    for (int k = 0; k < 5000; ++k) {
        const auto triangle = static_cast<std::uint32_t>(random.next() % mesh.triangles.size());
        const Vector3d point = mesh.corner(triangle, 0) + random_step(random, 0.1);
        const auto found = follower.find(point, triangle);
        for (const std::uint32_t from : {found->place.triangle, TriangleEdge::none}) {
            const auto again = follower.find(point, from);
            EXPECT_EQ(again->place.triangle, found->place.triangle);
            EXPECT_EQ(again->place.weights, found->place.weights);
            EXPECT_EQ(again->position, found->position);
        }
    }
}

/// For points beyond the boundary, the nearest place is on the boundary.
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

/// If cells move little, most of them stay inside their triangles.
TEST(PlaceFollower, MostlyStaysWherePlacesMoveLittle) {
    const SurfaceMesh mesh = *sphere_mesh(1, 0.05);
    const PlaceFollower follower(mesh);
    RandomStream random(3);
    int stays = 0;
    constexpr int points = 2000;
    for (int k = 0; k < points; ++k) {
        const Vector3d outside = unit(random_step(random, 1)) * 1.01;
        const auto found = follower.find(outside, TriangleEdge::none);
        const Vector3d point = outside + random_step(random, 0.001);
        stays += follower.stay(point, found->place.triangle) ? 1 : 0;
    }
    EXPECT_GT(stays, points * 8 / 10);
    EXPECT_FALSE(follower.stay({1, 0, 0}, TriangleEdge::none));
    EXPECT_FALSE(follower.stay({NAN, 0, 0}, 0));
}

/// A cell stays on its sheet when another sheet is near.
TEST(PlaceFollower, StaysOnItsSheet) {
    SurfaceMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                               {{{0, 1, 2}}, {{3, 4, 5}}});
    const PlaceFollower follower(mesh);
    EXPECT_EQ(follower.find({0.2, 0.2, 0.6}, 0)->place.triangle, 0U);
    EXPECT_EQ(follower.find({0.2, 0.2, 0.6}, TriangleEdge::none)->place.triangle, 1U);
}

}  // namespace
}  // namespace cascade::test
