// Gradients of cells, compared with functions whose gradients are known.
#include "surface/tangent_frame.h"
#include "unit/surface/cell_gradients.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

std::vector<Vector3d> weights_of(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                 int threads = 2) {
    Team team(threads);
    return cell_gradient_weights(mesh, cells, team, never);
}

std::vector<double> values(const SurfaceMesh& mesh, const SurfaceCells& cells,
                           const std::function<double(Vector3d)>& f) {
    std::vector<double> result;
    for (const SurfacePlace& place : cells.places) result.push_back(f(position_of(mesh, place)));
    return result;
}

TEST(CellGradient, IsExactForLinearFunctionsOnAPlane) {
    // An oblique plane of triangles of all sizes.
    const Vector3d e = unit(Vector3d{1, 2, -1}), f = unit(cross(e, Vector3d{0.3, 1, 1}));
    const SurfaceMesh mesh = sheet(7, 5, [&](double u, double v) {
        return e * (u * u + 0.1 * u) + f * (v + 0.2 * u * v);
    });
    const SurfaceCells cells = cells_of(mesh, 400);
    const Vector3d slope = e * 3.0 - f * 1.25;
    const std::vector<Vector3d> gradients =
        cell_gradients(cells, weights_of(mesh, cells),
                       values(mesh, cells, [&](Vector3d p) { return dot(p, slope) + 0.5; }));
    for (const Vector3d& gradient : gradients) EXPECT_LT(length(gradient - slope), 1e-10);
}

TEST(CellGradient, CrossesFoldsWithoutError) {
    // A sheet folded by a right angle, and a function that is linear when the sheet is unfolded.
    const SurfaceMesh mesh = sheet(2, 1, [](double u, double v) {
        return u <= 0.5 ? Vector3d{u, v, 0} : Vector3d{0.5, v, u - 0.5};
    });
    const SurfaceCells cells = cells_of(mesh, 300);
    const std::vector<Vector3d> gradients =
        cell_gradients(cells, weights_of(mesh, cells),
                       values(mesh, cells, [](Vector3d p) { return 2 * (p.x + p.z) - p.y; }));
    for (std::size_t k = 0; k < gradients.size(); ++k) {
        const bool is_upright = position_of(mesh, cells.places[k]).z > 0;
        const Vector3d wanted = is_upright ? Vector3d{0, -1, 2} : Vector3d{2, -1, 0};
        EXPECT_LT(length(gradients[k] - wanted), 1e-10) << k;
    }
}

TEST(CellGradient, FirstHarmonicsOfASphereAreOfFirstOrder) {
    std::vector<double> errors;
    for (const int n : {16, 32, 64}) {
        const SurfaceMesh mesh = sphere(n);
        const auto count = static_cast<std::size_t>(n * n);
        const SurfaceCells cells = cells_of(mesh, count);
        const std::vector<Vector3d> weights = weights_of(mesh, cells);
        double sum = 0;
        for (const Vector3d axis : {Vector3d{1, 0, 0}, Vector3d{0, 1, 0}, Vector3d{0, 0, 1}}) {
            const std::vector<Vector3d> gradients =
                cell_gradients(cells, weights,
                               values(mesh, cells, [&](Vector3d p) { return dot(axis, p); }));
            for (std::size_t k = 0; k < count; ++k) {
                const Vector3d p = unit(position_of(mesh, cells.places[k]));
                const double error = length(gradients[k] - (axis - p * dot(axis, p)));
                sum += error * error;
                const Vector3d normal = tangent_frame(mesh, cells.places[k].triangle).normal;
                EXPECT_LT(std::abs(dot(gradients[k], normal)), 1e-12);
            }
        }
        errors.push_back(std::sqrt(sum / static_cast<double>(3 * count)));
        RecordProperty("error_" + std::to_string(count), std::to_string(errors.back()));
    }
    EXPECT_LT(errors[0], 0.04);
    EXPECT_LT(errors[1], errors[0] / 1.6);
    EXPECT_LT(errors[2], errors[1] / 1.6);
}

/// Cells in a row determine only the component of the gradient along the row. The other component
/// is 0.
TEST(CellGradient, WhatCannotBeKnownIsZero) {
    const SurfaceMesh mesh = square();
    SurfaceCells cells;
    for (const double x : {0.2, 0.4, 0.6}) {
        cells.places.push_back({0, {1 - x, x - 0.1, 0.1}});  // The place (x, 0.1).
    }
    cells.areas = {1, 1, 1};
    cells.edges = {{1, 1, 0.2}, {0, 1, 0.2}, {2, 1, 0.2}, {1, 1, 0.2}};
    cells.ends = {1, 3, 4};
    const auto slope = values(mesh, cells, [](Vector3d p) { return 5 * p.x + 7 * p.y; });
    for (const Vector3d& gradient : cell_gradients(cells, weights_of(mesh, cells), slope)) {
        EXPECT_LT(length(gradient - Vector3d{5, 0, 0}), 1e-12);
    }

    cells.edges.clear();
    cells.ends = {0, 0, 0};
    for (const Vector3d& gradient : cell_gradients(cells, weights_of(mesh, cells), slope)) {
        EXPECT_EQ(gradient, Vector3d());
    }
}

TEST(CellGradient, PlacesThatCoincideAreHarmless) {
    const SurfaceMesh mesh = square();
    SurfaceCells cells;
    cells.places = {{0, {0.5, 0.3, 0.2}}, {0, {0.5, 0.3, 0.2}}};
    cells.areas = {1, 1};
    cells.edges = {{1, 1, 0}, {0, 1, 0}};
    cells.ends = {1, 2};
    for (const Vector3d& weight : weights_of(mesh, cells)) EXPECT_EQ(weight, Vector3d());
}

TEST(CellGradient, SizeOfTheModelAndThreadsDoNotMatter) {
    const SurfaceMesh mesh = torus(30, 16, 2, 0.8);
    const SurfaceCells cells = cells_of(mesh, 500);
    const std::vector<Vector3d> one = weights_of(mesh, cells, 1);
    EXPECT_EQ(one, weights_of(mesh, cells, 3));
    // Scaling by a power of two keeps the rounding.
    const double scale = std::ldexp(1.0, -200);
    SurfaceMesh tiny = mesh;
    for (Vector3d& p : tiny.points) p = p * scale;
    const std::vector<Vector3d> weights = weights_of(tiny, cells_of(tiny, 500));
    ASSERT_EQ(weights.size(), one.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
        EXPECT_LT(length(weights[k] * scale - one[k]), 1e-9 * length(one[k]));
    }
}

}  // namespace
}  // namespace cascade::test
