// Smooth normals, and creases.
#include "mesh/normals.h"

#include "unit/mesh/meshes.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

TEST(Normals, OfASpherePointOutwards) {
    const SurfaceMesh mesh = test::sphere(12);
    const std::vector<Vector3d> normals = point_normals(mesh);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        EXPECT_LT(length(normals[p] - mesh.points[p]), 0.02);
    }
    const CornerNormals corners = corner_normals(mesh);
    EXPECT_EQ(corners.normals, normals);  // A sphere has no creases.
    EXPECT_LT(length(corners.at(mesh, {5, {0.2, 0.3, 0.5}}) -
                     unit(position_of(mesh, {5, {0.2, 0.3, 0.5}}))),
              0.02);
}

TEST(Normals, ACubeKeepsItsEdges) {
    const SurfaceMesh mesh = test::box();
    const CornerNormals corners = corner_normals(mesh);
    EXPECT_EQ(corners.normals.size(), 24u);
    EXPECT_TRUE(std::is_sorted(corners.points.begin(), corners.points.end()));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vector3d flat = unit(mesh.double_area_normal(t));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t number = corners.numbers[t][k];
            EXPECT_EQ(corners.points[number], mesh.triangles[t][k]);
            EXPECT_LT(length(corners.normals[number] - flat), 1e-12);
        }
        EXPECT_LT(length(corners.at(mesh, {t, {0.5, 0.25, 0.25}}) - flat), 1e-12);
    }
    for (const Vector3d& normal : point_normals(mesh)) EXPECT_NEAR(length(normal), 1, 1e-12);
}

TEST(Normals, OfWhatCancelsOutAreSome) {
    SurfaceMesh mesh = test::square();
    mesh.points[2] = mesh.points[0];  // Neither triangle has an area.
    for (const Vector3d& normal : point_normals(mesh)) EXPECT_EQ(normal, (Vector3d{0, 0, 1}));
    const CornerNormals corners = corner_normals(mesh);
    for (const Vector3d& normal : corners.normals) EXPECT_EQ(normal, (Vector3d{0, 0, 1}));
}

}  // namespace
}  // namespace cascade
