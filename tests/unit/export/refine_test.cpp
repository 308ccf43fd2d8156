// Finer meshes of the same shape.
#include "export/refine.h"

#include "unit/export/example_surfaces.h"
#include "unit/surface/even_cells.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace cascade {
namespace {

double longest_edge(const SurfaceMesh& mesh) {
    double longest = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            longest = std::max(longest, length(mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)));
        }
    }
    return longest;
}

/// Expects edges of the wanted length, the same surface, and all attributes at the right positions.
void expect_refined(const SurfaceMesh& mesh, const RefinedMesh& fine) {
    test::expect_manifold(fine.mesh);
    const MeshFacts before = facts_of(mesh), after = facts_of(fine.mesh);
    EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.boundaries, before.boundaries);
    EXPECT_NEAR(after.area, before.area, 1e-9 * before.area);
    ASSERT_EQ(fine.places.size(), fine.mesh.points.size());
    for (std::size_t p = 0; p < fine.places.size(); ++p) {
        EXPECT_LT(length(position_of(mesh, fine.places[p]) - fine.mesh.points[p]), 1e-12) << p;
    }
    ASSERT_EQ(fine.origins.size(), fine.mesh.triangles.size());
    for (std::uint32_t t = 0; t < fine.origins.size(); ++t) {
        const std::array<double, 3> weights = {0.5, 0.2, 0.3};
        const Vector3d here = position_of(fine.mesh, {t, weights});
        EXPECT_LT(length(position_of(mesh, fine.origins[t].at(weights)) - here), 1e-12) << t;
    }
    EXPECT_TRUE(std::equal(mesh.points.begin(), mesh.points.end(), fine.mesh.points.begin()));
    EXPECT_EQ(fine.mesh.texture.size(), mesh.texture.empty() ? 0 : fine.mesh.triangles.size());
}

TEST(Refine, HalvesWhatIsTooLongAndNothingElse) {
    for (const SurfaceMesh& mesh : {test::box(), test::flat_square(1), test::sphere(3)}) {
        for (const double longest : {1.2, 0.5, 0.21, 0.07}) {
            const RefinedMesh fine = refined(mesh, longest, 1000000);
            expect_refined(mesh, fine);
            EXPECT_LE(longest_edge(fine.mesh), longest);
        }
    }
    EXPECT_EQ(refined(test::box(), 2, 1000000).mesh.triangles, test::box().triangles);
}

TEST(Refine, TrianglesThatAreShortAreLeft) {
    SurfaceMesh mesh = test::flat_square(4);
    for (Vector3d& p : mesh.points) p.x = p.x * p.x * 10;  // The columns are from 0.6 to 4.4 wide.
    const RefinedMesh fine = refined(mesh, 1, 1000000);
    expect_refined(mesh, fine);
    EXPECT_LE(longest_edge(fine.mesh), 1);
    EXPECT_EQ(std::count(fine.mesh.triangles.begin(), fine.mesh.triangles.end(), mesh.triangles[0]),
              1);
}

TEST(Refine, TextureAndAttributesLieBetweenThoseOfTheMesh) {
    SurfaceMesh mesh = test::flat_square(2);
    mesh.attributes.push_back(test::x_channel(mesh));
    const RefinedMesh fine = refined(mesh, 0.1, 1000000);
    expect_refined(mesh, fine);
    for (std::size_t p = 0; p < fine.mesh.points.size(); ++p) {
        EXPECT_NEAR(fine.mesh.attributes[0].values[p], fine.mesh.points[p].x, 1e-6);
    }
    for (std::size_t t = 0; t < fine.mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(fine.mesh.texture[t][k][0], fine.mesh.corner(t, k).x, 1e-6);
            EXPECT_NEAR(fine.mesh.texture[t][k][1], fine.mesh.corner(t, k).y, 1e-6);
        }
    }
}

TEST(Refine, StopsWhereThereWouldBeTooMany) {
    const RefinedMesh fine = refined(test::box(), 1e-300, 500);
    expect_refined(test::box(), fine);
    EXPECT_LE(fine.mesh.triangles.size(), 500u);
    EXPECT_GT(fine.mesh.triangles.size(), 120u);
}

}  // namespace
}  // namespace cascade
