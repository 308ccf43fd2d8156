// Cells of unusual surfaces: fins, slivers, wires, several parts, and very large or small meshes.
#include "mesh/shapes.h"
#include "surface/make_cells.h"
#include "unit/surface/cell_checks.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

using test::never;

Result<SurfaceCells> made_cells(const SurfaceMesh& mesh, std::uint64_t count) {
    Team team(2);
    CellOptions options;
    options.count = count;
    return make_cells(mesh, options, team, never);
}

void expect_fine(const SurfaceMesh& mesh, std::uint64_t count) {
    const auto cells = made_cells(mesh, count);
    ASSERT_TRUE(cells) << cells.error().message;
    EXPECT_EQ(cells->places.size(), count);
    test::expect_areas_sum_to(mesh, *cells);
    test::expect_symmetric_edges(*cells);
    EXPECT_EQ(cells->bare_area, 0);
    EXPECT_EQ(test::parts_of(*cells), facts_of(mesh).components);
}

SurfaceMesh mesh_of(PolygonSoup soup) { return make_mesh(std::move(soup))->mesh; }

PolygonSoup triangle(double height = 1) {
    return test::soup_of({{0, 0, 0}, {1, 0, 0}, {0, height, 0}}, {{0, 1, 2}});
}

PolygonSoup scaled(PolygonSoup soup, double by) {
    for (Vector3d& p : soup.points) p = p * by;
    return soup;
}

TEST(HardCells, OneTriangle) {
    for (const std::uint64_t count : {1, 2, 3, 100}) expect_fine(mesh_of(triangle()), count);
}

TEST(HardCells, OneOrTwoCellsOfAnything) {
    for (const SurfaceMesh& mesh : {test::box(), test::square(), test::sphere(8)}) {
        for (const std::uint64_t count : {1, 2, 3, 5}) expect_fine(mesh, count);
    }
}

TEST(HardCells, Slivers) {
    for (const double height : {1e-3, 1e-8}) {
        for (const std::uint64_t count : {1, 2, 50}) expect_fine(mesh_of(triangle(height)), count);
    }
}

TEST(HardCells, AWireLongerThanCellsReach) {
    // A strip 1000 times as long as wide. Its cells are so far apart that they do not push each
    // other.
    PolygonSoup soup;
    for (int k = 0; k <= 200; ++k) {
        soup.points.push_back({5.0 * k, 0, 0});
        soup.points.push_back({5.0 * k, 1, 0});
    }
    for (std::uint32_t k = 0; k < 200; ++k) {
        for (const std::uint32_t corner : {2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1})
            soup.corners.push_back(corner);
        soup.ends.push_back(soup.corners.size());
    }
    const SurfaceMesh mesh = mesh_of(std::move(soup));
    for (const std::uint64_t count : {1, 4, 30, 2000}) expect_fine(mesh, count);
}

/// The largest quotient of the sum of a cell's edge weights and the cell's area, where the unit of
/// area is the mean area of the cells. It is 3.46 for regular hexagons, and steps of diffusion must
/// be shorter by the same factor.
double largest_weight(const SurfaceCells& cells) {
    double total = 0, largest = 0;
    for (const double area : cells.areas) total += area;
    for (std::size_t k = 0; k < cells.places.size(); ++k) {
        double sum = 0;
        for (const VoronoiEdge& edge : cells.edges_of(k)) sum += edge.weight();
        largest = std::max(largest,
                           sum / cells.areas[k] * total / static_cast<double>(cells.places.size()));
    }
    return largest;
}

TEST(HardCells, ThinPartsHaveNoWeightyCells) {
    // Bars with three to twelve cells around them, whose sides overlap when they are unfolded.
    for (const double width : {0.02, 0.04, 0.08}) {
        const SurfaceMesh mesh = *box_mesh({1, width, width}, width / 4);
        for (const std::uint64_t count : {100, 400}) {
            expect_fine(mesh, count);
            EXPECT_LT(largest_weight(*made_cells(mesh, count)), 12) << width << ' ' << count;
        }
    }
    EXPECT_LT(largest_weight(*made_cells(*box_mesh({1, 1, 1}, 0.05), 4000)), 7);
}

TEST(HardCells, AFinOnABox) {
    PolygonSoup soup = test::cube();
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back({0, 0, 3});
    soup.points.push_back({1, 0, 3});
    for (const std::uint32_t corner : {4u, 5u, first + 1, first}) soup.corners.push_back(corner);
    soup.ends.push_back(soup.corners.size());
    for (const std::uint64_t count : {2, 10, 500}) expect_fine(mesh_of(soup), count);
}

TEST(HardCells, VeryLargeAndVerySmallModels) {
    const auto at_one = made_cells(test::box(), 300);
    for (const double size : {1e-60, 1e-9, 1e9, 1e60}) {
        const SurfaceMesh mesh = mesh_of(scaled(test::cube(), size));
        expect_fine(mesh, 300);
        const auto cells = made_cells(mesh, 300);
        EXPECT_EQ(cells->edges.size(), at_one->edges.size()) << size;
        EXPECT_NEAR(cells->areas[7] / size / size / at_one->areas[7], 1, 1e-3);
    }
}

TEST(HardCells, EveryPieceHasACell) {
    // A large box and forty small boxes, which have a smaller area than a cell.
    PolygonSoup soup = test::cube();
    for (int k = 0; k < 40; ++k)
        test::append(soup, scaled(test::cube(), 0.001 * (k + 1)), {2.0 + k, 0, 0});
    const SurfaceMesh mesh = mesh_of(std::move(soup));
    expect_fine(mesh, 41);
    expect_fine(mesh, 42);
    expect_fine(mesh, 600);
    const auto few = made_cells(mesh, 40);
    ASSERT_FALSE(few);
    EXPECT_EQ(few.error().message, "40 cells cannot cover a surface of 41 separate parts");
    EXPECT_EQ(few.error().hint, "use 41 cells or more, or join the parts");
}

TEST(HardCells, RefusesWhatCannotBe) {
    EXPECT_FALSE(made_cells(test::box(), 0));
    EXPECT_FALSE(made_cells(test::box(), std::uint64_t{1} << 32));
    EXPECT_FALSE(made_cells({}, 3));
    CellOptions options;
    options.count = 1'000'000'000;
    EXPECT_GT(memory_of_cells(test::box(), options), 1e11);
    options.count = 10;
    Team team(1);
    for (const double ratio : {0.5, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
        Anisotropy anisotropy = {std::vector<Vector3d>(12, {1, 0, 0}), std::vector<double>(12, 2)};
        anisotropy.ratio[11] = ratio;
        options.anisotropy = &anisotropy;
        EXPECT_FALSE(make_cells(test::box(), options, team, never));
        anisotropy.ratio.pop_back();
        EXPECT_FALSE(make_cells(test::box(), options, team, never));
    }
}

TEST(HardCells, PlacesThatCoincideArePushedApart) {
    const SurfaceMesh mesh = test::box();
    Team team(2);
    std::vector<SurfacePlace> places(60, {0, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
    relax(mesh, places, 60, team, never);
    for (std::size_t a = 0; a < places.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            EXPECT_GT(length(position_of(mesh, places[a]) - position_of(mesh, places[b])), 0.02);
        }
    }
}

}  // namespace
}  // namespace cascade
