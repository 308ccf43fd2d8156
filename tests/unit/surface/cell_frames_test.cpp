// The axes for angles on a surface, and bounds of diffusion with a direction in each cell.
#include "surface/cell_frames.h"
#include "surface/cell_gradient.h"
#include "surface/make_cells.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cascade::test {
namespace {

std::vector<double> evenness(const SurfaceMesh& mesh, const SurfaceCells& cells, bool are_spread,
                             int threads = 2) {
    Team team(threads);
    return evenness_of_cells(mesh, cells, cell_frames(mesh, cells),
                             conduction_of(cells, are_spread, 1), team, never);
}

TEST(CellFrames, PointRightAndDownAsInAPicture) {
    // An upright sheet that faces the viewer, and a sheet that rises towards the back.
    const SurfaceMesh wall = sheet(5, 5, [](double u, double v) { return Vector3d{u, v, 0}; });
    const SurfaceMesh slope = sheet(5, 5, [](double u, double v) { return Vector3d{u, v, -v}; });
    for (const SurfaceMesh* mesh : {&wall, &slope}) {
        const SurfaceCells cells = face_cells(*mesh);
        const CellFrames frames = cell_frames(*mesh, cells);
        for (std::size_t k = 0; k < cells.places.size(); ++k) {
            const Vector3d down = mesh == &wall ? Vector3d{0, -1, 0} : unit(Vector3d{0, -1, 1});
            EXPECT_LT(length(frames.right[k] - Vector3d{1, 0, 0}), 1e-12);
            EXPECT_LT(length(frames.down[k] - down), 1e-12);
        }
    }
}

TEST(CellFrames, AreFilledInWhereTheSurfaceIsLevel) {
    const SurfaceMesh floor = sheet(5, 5, [](double u, double v) { return Vector3d{u, 0, -v}; });
    const CellFrames frames = cell_frames(floor, face_cells(floor));
    for (std::size_t k = 0; k < frames.right.size(); ++k) {
        EXPECT_NEAR(length(frames.right[k]), 1, 1e-12);
        EXPECT_NEAR(length(frames.down[k]), 1, 1e-12);
        EXPECT_NEAR(dot(frames.right[k], frames.down[k]), 0, 1e-12);
        EXPECT_NEAR(std::abs(cross(frames.right[k], frames.down[k]).y), 1, 1e-12);
    }
}

TEST(CellFrames, CellsAreEvenWhereTheirNeighboursAre) {
    const SurfaceMesh flat = sheet(12, 12, [](double u, double v) { return Vector3d{u, v, 0}; });
    const SurfaceCells squares = vertex_cells(flat);
    const std::vector<double> of_squares = evenness(flat, squares, false);
    for (std::size_t k = 0; k < of_squares.size(); ++k) {
        const auto& place = position_of(flat, squares.places[k]);
        const bool is_inside = std::min({place.x, 1 - place.x, place.y, 1 - place.y}) > 0.01;
        if (!is_inside) continue;
        EXPECT_NEAR(of_squares[k], 1, 1e-9);
    }
    std::vector<double> spread = evenness(flat, cells_of(flat, 900), true);
    std::sort(spread.begin(), spread.end());
    EXPECT_GT(spread[spread.size() / 20], 0.9);
}

TEST(CellFrames, SliversHaveNoDirection) {
    // Among wide columns of cells are some that are a hundred times as high as wide.
    const SurfaceMesh mesh = sheet(12, 6, [](double u, double v) {
        const double column = std::round(u * 12);
        return Vector3d{std::floor(column / 2) + (std::fmod(column, 2) > 0.5 ? 0.99 : 0), 6 * v, 0};
    });
    const std::vector<double> found = evenness(mesh, face_cells(mesh), false);
    EXPECT_LT(*std::min_element(found.begin(), found.end()), 0.1);
    for (const double each : found) {
        EXPECT_GE(each, 0);
        EXPECT_LE(each, 1 + 1e-12);
    }
}

TEST(CellFrames, DependOnNoThreads) {
    const SurfaceMesh mesh = sheet(6, 6, [](double u, double v) {
        return Vector3d{u, v, 0.3 * u * v};
    });
    const SurfaceCells cells = cells_of(mesh, 200);
    EXPECT_EQ(evenness(mesh, cells, true, 1), evenness(mesh, cells, true, 5));
}

}  // namespace
}  // namespace cascade::test
