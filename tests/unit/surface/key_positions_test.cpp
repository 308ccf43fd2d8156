// Values that are given at key positions, and the cells nearest to points.
#include "surface/cell_finder.h"
#include "surface/graph_diffusion.h"
#include "surface/key_positions.h"
#include "surface/nearest_place.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace cascade::test {
namespace {

std::vector<double> smooth(const SurfaceCells& cells, std::vector<double> values, double length,
                           int threads = 2) {
    Team team(threads);
    return smoothed(cells, std::move(values), length, team, never);
}

double mean_of(const SurfaceCells& cells, const std::vector<double>& values) {
    double sum = 0, area = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        sum += values[k] * cells.areas[k];
        area += cells.areas[k];
    }
    return sum / area;
}

SurfaceMesh two_cubes() {
    PolygonSoup soup = cube();
    append(soup, cube(), {5, 0, 0});
    return make_mesh(std::move(soup))->mesh;
}

TEST(KeyPositions, EachCellHasTheValueOfTheNearestKey) {
    const SurfaceMesh mesh = sphere(20);
    const SurfaceCells cells = cells_of(mesh, 1500);
    // The keys are not on the surface, so the nearest place on it counts.
    const std::vector<KeyValue> keys = {{{0, 0, 3}, 1}, {{0, 0, -0.2}, 2}, {{1.5, 0, 0}, 7}};
    const std::vector<double> values = nearest_key_values(mesh, cells, keys, never);
    std::size_t sure = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Vector3d p = unit(position_of(mesh, cells.places[k]));
        std::array<std::pair<double, double>, 3> angles;
        for (std::size_t n = 0; n < 3; ++n) {
            angles[n] = {std::acos(std::clamp(dot(p, unit(keys[n].position)), -1.0, 1.0)),
                         keys[n].value};
        }
        std::sort(angles.begin(), angles.end());
        if (angles[1].first - angles[0].first < 0.05) continue;
        ++sure;
        EXPECT_EQ(values[k], angles[0].second);
    }
    EXPECT_GT(sure, 1300u);
}

TEST(KeyPositions, PiecesWithoutAKeyTakeTheNearestInSpace) {
    const SurfaceMesh mesh = two_cubes();
    const SurfaceCells cells = cells_of(mesh, 300);
    const std::vector<KeyValue> keys = {{{0, 0.5, 0.5}, 3}, {{1, 0.5, 0.5}, 4}, {{NAN, 0, 0}, 9}};
    const std::vector<double> values = nearest_key_values(mesh, cells, keys, never);
    std::size_t of_first = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (position_of(mesh, cells.places[k]).x > 3) {
            EXPECT_EQ(values[k], 4);
        }
        of_first += values[k] == 3;
    }
    EXPECT_GT(of_first, 50u);
    EXPECT_EQ(nearest_key_values(mesh, cells, {}, never), std::vector<double>(300));
}

/// Smoothing turns a step on a long flat strip into the error function.
TEST(Smoothing, SpreadsLikeAGaussian) {
    const SurfaceMesh mesh = sheet(40, 4, [](double u, double v) {
        return Vector3d{10 * u, v, 0};
    });
    const SurfaceCells cells = cells_of(mesh, 3000);
    std::vector<double> step;
    for (const SurfacePlace& place : cells.places)
        step.push_back(position_of(mesh, place).x > 5 ? 1000 : 999);
    const double length = 0.8;
    const std::vector<double> found = smooth(cells, step, length);
    for (std::size_t k = 0; k < found.size(); ++k) {
        const double x = position_of(mesh, cells.places[k]).x - 5;
        const double exact = 999.5 + 0.5 * std::erf(x / length / std::sqrt(2.0));
        EXPECT_NEAR(found[k], exact, 0.03) << x;
    }
    EXPECT_NEAR(mean_of(cells, found), mean_of(cells, step), 1e-6);
}

TEST(Smoothing, FromNothingToTheMeanOfEachPiece) {
    const SurfaceMesh mesh = two_cubes();
    const SurfaceCells cells = cells_of(mesh, 600);
    std::vector<double> values, of_first, of_second;
    for (const SurfacePlace& place : cells.places) {
        const Vector3d p = position_of(mesh, place);
        values.push_back(p.x > 3 ? 5 + p.y : p.z);
    }
    EXPECT_EQ(smooth(cells, values, 0), values);
    const std::vector<double> flat = smooth(cells, values, std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < flat.size(); ++k) {
        EXPECT_NEAR(flat[k], position_of(mesh, cells.places[k]).x > 3 ? 5.5 : 0.5, 0.01);
    }
    double last = 1;
    for (const double length : {0.1, 0.3, 1.0}) {
        const std::vector<double> some = smooth(cells, values, length);
        EXPECT_NEAR(mean_of(cells, some), mean_of(cells, values), 1e-6);
        double range = 0;
        for (std::size_t k = 0; k < some.size(); ++k) {
            if (position_of(mesh, cells.places[k]).x < 3)
                range = std::max(range, std::abs(some[k] - 0.5));
        }
        EXPECT_LT(range, last);
        last = range;
    }
}

TEST(Smoothing, StaysBetweenAndDoesNotDependOnThreads) {
    const SurfaceMesh mesh = torus(30, 15, 2, 0.8);
    const SurfaceCells cells = cells_of(mesh, 5000);
    std::vector<double> values;
    for (const SurfacePlace& place : cells.places) {
        values.push_back(position_of(mesh, place).x > 0 ? 2.0 : -1.0);
    }
    const std::vector<double> one = smooth(cells, values, 0.5, 1);
    EXPECT_EQ(one, smooth(cells, values, 0.5, 3));
    for (const double value : one) {
        EXPECT_GE(value, -1);
        EXPECT_LE(value, 2);
    }
    EXPECT_EQ(smooth(cells, std::vector<double>(5000, 0.1), 0.5), std::vector<double>(5000, 0.1));
}

/// Waves on a ring decay as in four implicit steps, with any number of threads.
TEST(GraphDiffusion, WavesOnARing) {
    constexpr std::uint32_t count = 210'000;
    DiffusionGraph<double> graph;
    std::vector<double> wave;
    for (std::uint32_t k = 0; k < count; ++k) {
        graph.masses.push_back(2);
        graph.links.push_back({(k + 1) % count, 0.5, 0.5});
        graph.links.push_back({(k + count - 1) % count, 0.5, 0.5});
        graph.ends.push_back(graph.links.size());
        wave.push_back(std::cos(2 * std::numbers::pi * k / 30));
    }
    const double time = 80, rate = (1 - std::cos(2 * std::numbers::pi / 30)) * 0.5;
    Team one(1), four(4);
    const std::vector<double> found = diffused(graph, wave, time, four, never);
    EXPECT_EQ(found, diffused(graph, wave, time, one, never));
    const double left = std::pow(1 + rate * time / 4, -4);
    for (std::size_t k = 0; k < count; ++k) ASSERT_NEAR(found[k], wave[k] * left, 1e-5);
}

/// The cells at the places nearest to points.
std::vector<std::uint32_t> cells_at(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                    std::span<const Vector3d> points) {
    const NearestPlace nearest(mesh);
    CellFinder finder(mesh, cells.places);
    std::vector<std::uint32_t> found;
    for (const Vector3d& point : points) found.push_back(finder.at(nearest.find(point).value()));
    return found;
}

TEST(CellFinder, AreTheNearestOfAll) {
    const SurfaceMesh mesh = sphere(30);
    const SurfaceCells cells = cells_of(mesh, 2000);
    std::vector<Vector3d> points;
    for (int k = 0; k < 60; ++k) {
        points.push_back(unit(Vector3d{std::sin(k * 1.3), std::cos(k * 2.1), std::sin(k * 0.7)}) *
                         1.2);
    }
    const std::vector<std::uint32_t> found = cells_at(mesh, cells, points);
    const NearestPlace nearest(mesh);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vector3d below = position_of(mesh, nearest.find(points[k]).value());
        const auto away = [&](std::size_t cell) {
            return length(position_of(mesh, cells.places[cell]) - below);
        };
        double best = 9;
        for (std::size_t cell = 0; cell < 2000; ++cell) best = std::min(best, away(cell));
        EXPECT_LT(away(found[k]), best + 0.001);
    }
    for (std::uint32_t cell = 0; cell < 2000; cell += 37) {
        const Vector3d here = position_of(mesh, cells.places[cell]);
        EXPECT_EQ(cells_at(mesh, cells, std::span(&here, 1))[0], cell);
    }
}

TEST(CellFinder, DoNotJumpThroughThinWalls) {
    // Two sides of a sheet, a hundredth apart: the cells of the lower one are nearer in space.
    PolygonSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 3, 2, 1}});
    append(soup, soup_of({{0, 0, 0.01}, {1, 0, 0.01}, {1, 1, 0.01}, {0, 1, 0.01}}, {{0, 1, 2, 3}}));
    const SurfaceMesh mesh = make_mesh(std::move(soup))->mesh;
    const SurfaceCells cells = cells_of(mesh, 200);
    std::vector<Vector3d> points;
    for (int k = 0; k < 100; ++k) points.push_back({0.01 * k, std::fmod(0.37 * k, 1.0), 0.02});
    for (const std::uint32_t cell : cells_at(mesh, cells, points)) {
        EXPECT_NEAR(position_of(mesh, cells.places[cell]).z, 0.01, 1e-9);
    }
}

TEST(CellFinder, WhatCannotBeFound) {
    const SurfaceMesh mesh = two_cubes();
    SurfaceCells cells;
    const std::vector<Vector3d> points = {{5, 0, 0}};
    EXPECT_EQ(cells_at(mesh, cells, points)[0], CellFinder::nothing);
    cells.places = {{0, {1, 0, 0}}};  // The cell is on the first cube, and the point on the second.
    cells.areas = {1};
    cells.ends = {0};
    EXPECT_EQ(cells_at(mesh, cells, points)[0], 0);
}

}  // namespace
}  // namespace cascade::test
