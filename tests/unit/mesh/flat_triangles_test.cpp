// Triangles without area are removed, and attributes of the model's faces keep their positions.
#include "mesh/flat_triangles.h"

#include "mesh/edge_pairs.h"
#include "unit/mesh/measures.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

/// Adds texture coordinates and an attribute that depend on positions, and a face for each
/// triangle.
SurfaceMesh told(SurfaceMesh mesh) {
    mesh.attributes.push_back({"x", {}});
    for (const Vector3d& p : mesh.points)
        mesh.attributes[0].values.push_back(static_cast<float>(p.x));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        mesh.faces.push_back(t);
        auto& places = mesh.texture.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            places[k] = {static_cast<float>(mesh.corner(t, k).x),
                         static_cast<float>(mesh.corner(t, k).y)};
        }
    }
    return mesh;
}

void expect_told(const SurfaceMesh& mesh) {
    test::expect_manifold(mesh);
    ASSERT_EQ(mesh.texture.size(), mesh.triangles.size());
    ASSERT_EQ(mesh.faces.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_GT(mesh.double_area_normal(t).z, 0);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(mesh.texture[t][k][0], static_cast<float>(mesh.corner(t, k).x));
            EXPECT_EQ(mesh.texture[t][k][1], static_cast<float>(mesh.corner(t, k).y));
        }
    }
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        EXPECT_EQ(mesh.attributes[0].values[p], static_cast<float>(mesh.points[p].x));
    }
}

TEST(FlatTriangles, OneBetweenOthersIsFlippedIntoTheFaceBesideIt) {
    // Corner 4 lies on the diagonal from 0 to 2.
    SurfaceMesh mesh = told(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                                    {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}}));
    const auto done = remove_flat_triangles(mesh);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->merged, 1u);
    EXPECT_EQ(done->left_out + done->remaining, 0u);
    expect_told(mesh);
    EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 2, 3}));
    EXPECT_DOUBLE_EQ(mesh.total_area(), 1);
}

TEST(FlatTriangles, OneAtABoundaryIsLeftOut) {
    SurfaceMesh mesh = told(
        mesh_of({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0, 0}, {0.25, 0, 0}},
                {{1, 2, 5}, {5, 2, 3}, {1, 5, 4}, {5, 3, 4}}));
    const auto done = remove_flat_triangles(mesh);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->left_out, 1u);
    EXPECT_EQ(done->merged + done->remaining, 0u);
    expect_told(mesh);
    EXPECT_EQ(mesh.points.size(), 5u) << "points that no triangle uses are gone";
    EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(facts_of(mesh).euler_characteristic, 1);
}

TEST(FlatTriangles, WhereAPointHeldPartsTogetherItIsDoubled) {
    // Corner 2 of the flat triangle lies on its longest edge, which is at the boundary. Two other
    // triangles are at its short edges.
    SurfaceMesh mesh = told(mesh_of({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {1.5, 1, 0}},
                                    {{0, 1, 2}, {0, 2, 3}, {2, 1, 4}}));
    const auto done = remove_flat_triangles(mesh);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->left_out, 1u);
    expect_told(mesh);
    EXPECT_EQ(mesh.points.size(), 6u);
    EXPECT_EQ(facts_of(mesh).components, 2u);
}

TEST(FlatTriangles, NoTwoPointsGetASecondEdge) {
    // A closed surface of four triangles in one plane: flipping the flat triangle's edge would make
    // a second edge from 2 to 3.
    SurfaceMesh mesh = mesh_of({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, -1, 0}},
                               {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}});
    const SurfaceMesh before = mesh;
    const auto done = remove_flat_triangles(mesh);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->remaining, 1u);
    EXPECT_EQ(done->merged + done->left_out, 0u);
    EXPECT_EQ(mesh.triangles, before.triangles);
}

}  // namespace
}  // namespace cascade
