// Facts about texture coordinates, for coordinates made for the tests.
#include "atlas/texture_facts.h"

#include "mesh/edge_pairs.h"
#include "mesh/shapes.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace cascade {
namespace {

/// The unit square of two triangles. A function of x and y gives the texture coordinates.
SurfaceMesh square(const std::function<TexturePlace(float x, float y)>& place) {
    SurfaceMesh mesh =
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    for (const auto& corners : mesh.triangles) {
        mesh.texture.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d& p = mesh.points[corners[k]];
            mesh.texture.back()[k] = place(static_cast<float>(p.x), static_cast<float>(p.y));
        }
    }
    return mesh;
}

TEST(TextureFacts, OfASquareItself) {
    const TextureFacts facts = texture_facts(square([](float x, float y) {
        return TexturePlace{x / 2, y / 2};
    }));
    EXPECT_EQ(facts.charts, 1u);
    EXPECT_NEAR(facts.covered, 0.25, 0.002);
    EXPECT_EQ(facts.shared, 0);
    EXPECT_EQ(facts.mirrored, 0);
    EXPECT_NEAR(facts.mean, 1, 1e-6);
    EXPECT_NEAR(facts.worst, 1, 1e-6);
}

TEST(TextureFacts, OfAStretchedSquare) {
    // Four times as wide as high: compared with the square of the same area, lengths change by 2 in
    // both directions.
    const TextureFacts facts = texture_facts(square([](float x, float y) {
        return TexturePlace{x, y / 4};
    }));
    EXPECT_NEAR(facts.mean, 2, 1e-6);
    EXPECT_NEAR(facts.worst, 2, 1e-6);
}

TEST(TextureFacts, OfAMirroredSquare) {
    const TextureFacts facts = texture_facts(square([](float x, float y) {
        return TexturePlace{1 - x, y};
    }));
    EXPECT_EQ(facts.mirrored, 1);
    EXPECT_NEAR(facts.worst, 1, 1e-6);
}

TEST(TextureFacts, OfAPictureThatRepeats) {
    const TextureFacts facts = texture_facts(square([](float x, float y) {
        return TexturePlace{2 * x, y};
    }));
    EXPECT_NEAR(facts.covered, 1, 1e-9);
    EXPECT_NEAR(facts.shared, 1, 1e-9);
}

TEST(TextureFacts, OfHalvesInOnePlace) {
    SurfaceMesh mesh = square([](float x, float y) { return TexturePlace{x, y}; });
    mesh.texture[1] = {mesh.texture[0][0], mesh.texture[0][2], mesh.texture[0][1]};
    const TextureFacts facts = texture_facts(mesh);
    EXPECT_EQ(facts.charts, 1u) << "folded along the diagonal";
    EXPECT_NEAR(facts.shared, 0.5, 0.002);
    EXPECT_NEAR(facts.mirrored, 0.5, 1e-9);
}

TEST(TextureFacts, OfTrianglesThatCannotBeDrawn) {
    SurfaceMesh mesh = square([](float x, float) { return TexturePlace{x, 0}; });
    mesh.texture[1][0][0] = std::numeric_limits<float>::quiet_NaN();
    const TextureFacts facts = texture_facts(mesh);
    EXPECT_EQ(facts.without_area, 1u);
    EXPECT_EQ(facts.without_place, 1u);
    EXPECT_EQ(facts.covered, 0);
}

// Built-in shapes have coordinates. Those of the torus are a rectangle, which stretches rings.
TEST(TextureFacts, OfATorus) {
    const TextureFacts facts = texture_facts(*torus_mesh(1, 0.4, 0.1));
    EXPECT_EQ(facts.mirrored, 0);
    EXPECT_NEAR(facts.covered, 1, 0.01);
    EXPECT_EQ(facts.shared, 0);
    EXPECT_GT(facts.worst, 1.3);
}

}  // namespace
}  // namespace cascade
