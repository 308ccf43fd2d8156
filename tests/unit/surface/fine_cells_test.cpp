// Cells of surfaces with many more triangles than cells. They are made on a coarse copy of the
// surface, and must be as good as cells made on the surface itself.
#include "core/hash.h"
#include "mesh/coarse_copy.h"
#include "mesh/shapes.h"
#include "surface/cells_by_copy.h"
#include "unit/surface/cell_checks.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cascade {
namespace {

using test::never;

CellOptions options_for(std::uint64_t count) {
    CellOptions options;
    options.count = count;
    return options;
}

SurfaceCells cells_by_copy_of(const SurfaceMesh& mesh, std::uint64_t count, int threads = 2) {
    Team team(threads);
    EXPECT_TRUE(is_fine(mesh, options_for(count)));
    Result<SurfaceCells> cells = cells_by_copy(mesh, options_for(count), team, never);
    EXPECT_TRUE(cells);
    return cells ? *std::move(cells) : SurfaceCells{};
}

SurfaceCells cells_on_the_surface_itself(const SurfaceMesh& mesh, std::size_t count) {
    return test::cells_of(mesh, count);
}

void expect_fine(const SurfaceMesh& mesh, const SurfaceCells& cells, std::size_t count) {
    ASSERT_EQ(cells.places.size(), count);
    test::expect_areas_sum_to(mesh, cells);
    test::expect_symmetric_edges(cells);
    EXPECT_EQ(cells.bare_area, 0);
    EXPECT_EQ(test::parts_of(cells), facts_of(mesh).components);
    for (const SurfacePlace& place : cells.places) {
        ASSERT_LT(place.triangle, mesh.triangles.size());
        EXPECT_NEAR(place.weights[0] + place.weights[1] + place.weights[2], 1, 1e-12);
        for (const double weight : place.weights) EXPECT_GE(weight, 0);
    }
}

/// A sphere whose points are moved off by a fraction of the triangles' edges, as in a scan.
SurfaceMesh rough_sphere(int n, double off) {
    SurfaceMesh mesh = test::sphere(n);
    for (std::uint32_t k = 0; k < mesh.points.size(); ++k) {
        const double by = pcg4d({k, 1, 2, 3})[0] / 4294967296.0 - 0.5;
        mesh.points[k] = mesh.points[k] * (1 + 2 * off * by / n);
    }
    return mesh;
}

TEST(FineCells, SphericalHarmonicsDecayAsOnTheSurfaceItself) {
    const SurfaceMesh mesh = test::sphere(60);
    const SurfaceCells by_copy = cells_by_copy_of(mesh, 1000);
    const SurfaceCells itself = cells_on_the_surface_itself(mesh, 1000);
    expect_fine(mesh, by_copy, 1000);
    EXPECT_NEAR(test::harmonics_error(mesh, by_copy), test::harmonics_error(mesh, itself), 1e-3);
    EXPECT_LT(test::relative_deviation(by_copy.areas),
              1.1 * test::relative_deviation(itself.areas));
    EXPECT_LT(test::unevenness(mesh, by_copy.places), 1.1 * test::unevenness(mesh, itself.places));
}

TEST(FineCells, ThreadsDoNotMatter) {
    const SurfaceMesh mesh = test::sphere(30);
    const SurfaceCells one = cells_by_copy_of(mesh, 300, 1), three = cells_by_copy_of(mesh, 300, 3);
    EXPECT_EQ(one.areas, three.areas);
    for (std::size_t k = 0; k < 300; ++k) {
        EXPECT_EQ(one.places[k].triangle, three.places[k].triangle);
        EXPECT_EQ(one.places[k].weights, three.places[k].weights);
    }
}

TEST(FineCells, RoughnessOfAScanDoesNotMatter) {
    const SurfaceMesh mesh = rough_sphere(60, 0.3);
    const SurfaceCells cells = cells_by_copy_of(mesh, 1000);
    expect_fine(mesh, cells, 1000);
    EXPECT_NEAR(static_cast<double>(cells.edges.size()) / 1000, 6, 0.1);
    EXPECT_LT(test::relative_deviation(cells.areas), 0.08);
}

TEST(FineCells, SheetsThatAreNearInSpaceAloneStayApart) {
    // A plate a hundred times as wide as thick, with cells five times as wide as its thickness.
    // Cells at the rim are left out.
    const SurfaceMesh mesh = *box_mesh({1, 0.01, 1}, 0.01);
    const std::size_t count = 800;
    const SurfaceCells cells = cells_by_copy_of(mesh, count);
    expect_fine(mesh, cells, count);
    const auto position = [&](std::size_t cell) { return position_of(mesh, cells.places[cell]); };
    const auto is_inside = [](Vector3d p) { return std::max(std::abs(p.x), std::abs(p.z)) < 0.37; };
    std::size_t above = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const Vector3d here = position(k);
        above += here.y > 0;
        if (!is_inside(here)) continue;
        for (const VoronoiEdge& edge : cells.edges_of(k)) {
            EXPECT_GT(here.y * position(edge.neighbour).y, 0) << "cell " << k;
        }
    }
    EXPECT_NEAR(static_cast<double>(above), count / 2.0, 0.03 * count);
}

TEST(FineCells, ComponentsShareCellsByTheirArea) {
    // Spheres of radius 1 and 0.2: one has 25 times the area of the other.
    PolygonSoup soup;
    for (const double radius : {0.2, 1.0}) {
        const SurfaceMesh sphere = test::sphere(40);
        PolygonSoup one;
        for (const Vector3d& p : sphere.points) one.points.push_back(p * radius);
        for (const auto& triangle : sphere.triangles) {
            one.corners.insert(one.corners.end(), triangle.begin(), triangle.end());
            one.ends.push_back(one.corners.size());
        }
        test::append(soup, one, {3 * radius, 0, 0});
    }
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const SurfaceCells cells = cells_by_copy_of(mesh, 520);
    expect_fine(mesh, cells, 520);
    std::size_t small = 0;
    for (const SurfacePlace& place : cells.places) small += position_of(mesh, place).x < 1;
    EXPECT_EQ(small, 20u);
}

TEST(FineCells, DirectionsStretchThem) {
    const SurfaceMesh mesh = test::sheet(120, 120, [](double u, double v) {
        return Vector3d{u, v, 0};
    });
    const std::size_t triangles = mesh.triangles.size();
    const Anisotropy anisotropy = {std::vector<Vector3d>(triangles, {1, 0, 0}),
                                   std::vector<double>(triangles, 3)};
    CellOptions options = options_for(600);
    options.anisotropy = &anisotropy;
    Team team(2);
    const Result<SurfaceCells> cells = cells_by_copy(mesh, options, team, never);
    ASSERT_TRUE(cells);
    double along = 0, across = 0;
    for (std::size_t k = 0; k < 600; ++k) {
        for (const VoronoiEdge& edge : cells->edges_of(k)) {
            const Vector3d apart = position_of(mesh, cells->places[edge.neighbour]) -
                                   position_of(mesh, cells->places[k]);
            along += apart.x * apart.x;
            across += apart.y * apart.y;
        }
    }
    EXPECT_NEAR(std::sqrt(along / across), 3, 0.3);
}

TEST(CoarseCopy, KeepsHandlesComponentsAndBoundaries) {
    // The tube of the torus is thinner than the edges of a coarse copy would be.
    for (const SurfaceMesh& mesh :
         {*torus_mesh(1, 0.05, 0.01), test::sphere(40), test::cylinder(100, 60, 0.3, 1)}) {
        const Result<CoarseCopy> copy = coarse_copy(mesh, 0.2);
        ASSERT_TRUE(copy);
        EXPECT_LT(copy->mesh.triangles.size(), mesh.triangles.size() / 10);
        test::expect_manifold(copy->mesh);
        const MeshFacts before = facts_of(mesh), after = facts_of(copy->mesh);
        EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
        EXPECT_EQ(after.components, before.components);
        EXPECT_EQ(after.boundary_edges, before.boundary_edges);
        EXPECT_EQ(after.boundaries, before.boundaries);
        for (std::size_t p = 0; p < copy->merged.size(); ++p) {
            EXPECT_LT(length(copy->mesh.points[copy->merged[p]] - mesh.points[p]), 0.4);
        }
    }
}

}  // namespace
}  // namespace cascade
