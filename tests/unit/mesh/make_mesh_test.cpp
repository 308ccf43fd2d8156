// Models without faults, and repairs of models with faults.
#include "unit/mesh/soups.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace cascade {
namespace {

using test::append;
using test::cube;
using test::expect_manifold;
using test::soup_of;
using test::volume_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

MadeMesh made(PolygonSoup soup) {
    auto result = make_mesh(std::move(soup));
    EXPECT_TRUE(result) << (result ? "" : result.error().message);
    if (!result) return {};
    expect_manifold(result->mesh);
    return *std::move(result);
}

TEST(MakeMesh, ACubeIsAClosedSurface) {
    const MadeMesh box = made(cube());
    EXPECT_THAT(box.repairs, IsEmpty());
    const MeshFacts facts = facts_of(box.mesh);
    EXPECT_EQ(facts.points, 8u);
    EXPECT_EQ(facts.triangles, 12u);
    EXPECT_EQ(facts.edges, 18u);
    EXPECT_EQ(facts.components, 1u);
    EXPECT_EQ(facts.boundaries, 0u);
    EXPECT_EQ(facts.euler_characteristic, 2);
    EXPECT_DOUBLE_EQ(facts.area, 6);
    EXPECT_DOUBLE_EQ(volume_of(box.mesh), 1);
    EXPECT_EQ(facts.high, (Vector3d{1, 1, 1}));
}

TEST(MakeMesh, ATorusHasTheEulerCharacteristicOfATorus) {
    constexpr std::uint32_t n = 24;
    PolygonSoup soup;
    const double turn = 2 * std::numbers::pi / n;
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const double out = 3 + std::cos(j * turn);
            soup.points.push_back(
                {out * std::cos(i * turn), out * std::sin(i * turn), std::sin(j * turn)});
            const std::uint32_t east = (i + 1) % n, south = (j + 1) % n;
            soup.corners.insert(soup.corners.end(),
                                {j * n + i, j * n + east, south * n + east, south * n + i});
            soup.ends.push_back(soup.corners.size());
        }
    }
    const MeshFacts facts = facts_of(made(soup).mesh);
    EXPECT_EQ(facts.euler_characteristic, 0);
    EXPECT_EQ(facts.components, 1u);
}

TEST(MakeMesh, BoundariesArePiecesOfRim) {
    PolygonSoup open = cube();
    open.ends.resize(4);  // Without two adjacent sides, there is one boundary.
    open.corners.resize(16);
    const MeshFacts one = facts_of(made(open).mesh);
    EXPECT_EQ(one.boundaries, 1u);
    EXPECT_EQ(one.boundary_edges, 6u);
    EXPECT_EQ(one.euler_characteristic, 1);

    const PolygonSoup tube =
        soup_of(cube().points, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
    const MeshFacts two = facts_of(made(tube).mesh);
    EXPECT_EQ(two.boundaries, 2u);
    EXPECT_EQ(two.euler_characteristic, 0);
}

TEST(MakeMesh, PointsInOnePlaceAreOne) {
    PolygonSoup loose;  // As in an STL file, each triangle has points of its own.
    const SurfaceMesh box = made(cube()).mesh;
    for (std::uint32_t t = 0; t < 12; ++t) {
        append(loose, soup_of({box.corner(t, 0), box.corner(t, 1), box.corner(t, 2)}, {{0, 1, 2}}));
    }
    const MadeMesh joined = made(loose);
    EXPECT_THAT(joined.repairs, ElementsAre("28 points were joined with others in the same place"));
    EXPECT_EQ(facts_of(joined.mesh).euler_characteristic, 2);
}

TEST(MakeMesh, TwoCubesAtAnEdgeBecomeTwoPieces) {
    PolygonSoup two = cube();
    append(two, cube(), {1, 1, 0});
    const MadeMesh parted = made(two);
    const MeshFacts facts = facts_of(parted.mesh);
    EXPECT_EQ(facts.boundaries, 0u);
    EXPECT_DOUBLE_EQ(facts.area, 12);
    EXPECT_EQ(facts.components, 2u);
    EXPECT_EQ(facts.euler_characteristic, 4);
    EXPECT_THAT(parted.repairs, testing::Contains(HasSubstr("1 edge with more than two faces")));
}

TEST(MakeMesh, TwoCubesAtAPointShareNoPoint) {
    PolygonSoup two = cube();
    append(two, cube(), {1, 1, 1});
    const MadeMesh parted = made(two);
    EXPECT_EQ(facts_of(parted.mesh).components, 2u);
    EXPECT_EQ(facts_of(parted.mesh).euler_characteristic, 4);
    EXPECT_THAT(parted.repairs,
                testing::Contains(
                    "1 point was doubled where the faces around it are not connected by edges"));
}

TEST(MakeMesh, AFinEndsWhereItMeetsTheSurface) {
    PolygonSoup finned = cube();
    finned.points.push_back({2, 0, 0});
    finned.points.push_back({2, 0, 1});
    finned.corners.insert(finned.corners.end(), {1, 8, 9, 5});  // Across the edge from 1 to 5.
    finned.ends.push_back(finned.corners.size());
    const MeshFacts facts = facts_of(made(finned).mesh);
    EXPECT_DOUBLE_EQ(facts.area, 7);
    EXPECT_EQ(facts.components, 2u);
    EXPECT_EQ(facts.boundaries, 1u);  // This is the boundary of the fin. The cube remains closed.
}

TEST(MakeMesh, FacesAreTurnedToAgree) {
    PolygonSoup mixed = cube();
    std::swap(mixed.corners[5], mixed.corners[7]);
    const MadeMesh agreed = made(mixed);
    EXPECT_THAT(agreed.repairs, ElementsAre("2 faces were turned to agree with the others"));
    EXPECT_DOUBLE_EQ(volume_of(agreed.mesh), 1);

    PolygonSoup inside_out = cube();
    for (std::size_t p = 0; p < 6; ++p)
        std::swap(inside_out.corners[4 * p], inside_out.corners[4 * p + 2]);
    const MadeMesh turned = made(inside_out);
    EXPECT_THAT(turned.repairs, ElementsAre("1 component was turned inside out"));
    EXPECT_DOUBLE_EQ(volume_of(turned.mesh), 1);
}

TEST(MakeMesh, AMoebiusStripIsCutOnce) {
    constexpr std::uint32_t n = 20;
    PolygonSoup strip;
    for (std::uint32_t k = 0; k < n; ++k) {
        const double angle = 2 * std::numbers::pi * k / n;
        for (const double side : {-0.5, 0.5}) {
            const double out = 3 + side * std::cos(angle / 2);
            strip.points.push_back(
                {out * std::cos(angle), out * std::sin(angle), side * std::sin(angle / 2)});
        }
        const std::uint32_t a = 2 * k, b = 2 * k + 1;
        const bool last = k + 1 == n;
        strip.corners.insert(strip.corners.end(), {a, last ? 1 : a + 2, last ? 0 : b + 2, b});
        strip.ends.push_back(strip.corners.size());
    }
    const MadeMesh cut = made(strip);
    const MeshFacts facts = facts_of(cut.mesh);
    EXPECT_EQ(facts.components, 1u);
    EXPECT_EQ(facts.boundaries, 1u);
    EXPECT_EQ(facts.euler_characteristic, 1);
    EXPECT_THAT(cut.repairs,
                testing::Contains("the surface had only one side and was cut along 1 edge"));
}

TEST(MakeMesh, WhatIsThereTwiceOrHasNoAreaIsLeftOut) {
    PolygonSoup soup = cube();
    append(soup, soup_of({cube().points[0], cube().points[3], cube().points[2], {9, 9, 9}},
                         {{0, 1, 2}, {0, 0, 1}, {1, 2}}));
    const MadeMesh clean = made(soup);
    EXPECT_EQ(facts_of(clean.mesh).triangles, 12u);
    EXPECT_THAT(clean.repairs, ElementsAre("1 point that no face uses was left out",
                                           "3 points were joined with others in the same place",
                                           "2 faces of fewer than three different corners left out",
                                           "1 face that was there twice was left out"));
}

TEST(MakeMesh, AFlatTriangleIsMerged) {
    // A square whose lower edge has a point in its middle on one side only.
    const MadeMesh merged =
        made(soup_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0, 0}, {1, -2, 0}},
                     {{0, 1, 2, 3}, {0, 4, 1}, {4, 0, 5}, {1, 4, 5}}));
    EXPECT_THAT(merged.repairs,
                testing::Contains("1 triangle without area merged with neighbours"));
    for (std::size_t t = 0; t < merged.mesh.triangles.size(); ++t)
        EXPECT_GT(merged.mesh.area(t), 0.1);
    EXPECT_DOUBLE_EQ(facts_of(merged.mesh).area, 6);
    EXPECT_EQ(facts_of(merged.mesh).euler_characteristic, 1);
}

TEST(MakeMesh, PolygonsOfAnyShapeKeepTheirArea) {
    // A comb with three teeth, which no fan from a corner can fill.
    const MadeMesh comb = made(soup_of({{0, 0, 0},
                                        {5, 0, 0},
                                        {5, 3, 0},
                                        {4, 3, 0},
                                        {4, 1, 0},
                                        {3, 1, 0},
                                        {3, 3, 0},
                                        {2, 3, 0},
                                        {2, 1, 0},
                                        {1, 1, 0},
                                        {1, 3, 0},
                                        {0, 3, 0}},
                                       {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}));
    EXPECT_EQ(facts_of(comb.mesh).triangles, 10u);
    EXPECT_NEAR(facts_of(comb.mesh).area, 11, 1e-12);
    for (std::size_t t = 0; t < 10; ++t) EXPECT_GT(comb.mesh.double_area_normal(t).z, 0);

    // A quadrilateral with a dent has one diagonal inside.
    const MadeMesh dart =
        made(soup_of({{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}}, {{0, 1, 2, 3}}));
    EXPECT_NEAR(facts_of(dart.mesh).area, 1, 1e-12);
}

TEST(MakeMesh, SizesOfAllOrdersAreMeasured) {
    for (const double size : {1e-9, 1.0, 1e9, 1e60}) {
        PolygonSoup scaled = cube();
        for (Vector3d& p : scaled.points) p = p * size;
        EXPECT_NEAR(facts_of(made(scaled).mesh).area / (6 * size * size), 1, 1e-12);
    }
}

TEST(MakeMesh, WhatCannotBeUsedIsRefused) {
    const auto refused = [](PolygonSoup soup) {
        const auto result = make_mesh(std::move(soup));
        return result ? std::string("made") : result.error().message;
    };
    PolygonSoup broken = cube();
    broken.points[3].y = std::nan("");
    EXPECT_EQ(refused(broken),
              "point 3 of the model, counted from 0, has the position (0, nan, 0)");
    PolygonSoup huge = cube();
    huge.points[6].x = 1e200;
    EXPECT_THAT(refused(huge), HasSubstr("too large to compute with"));
    EXPECT_EQ(refused(soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})),
              "the model's faces have no area");
    EXPECT_EQ(refused({}), "the model's faces have no area");
}

}  // namespace
}  // namespace cascade
