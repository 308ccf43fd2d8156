// Blurs by diffusion, compared with blurs by a Gaussian.
#include "surface/blur_cells.h"

#include "core/hash.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::test {
namespace {

double total(const SurfaceCells& cells, const std::vector<float>& values) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        sum += static_cast<double>(values[k]) * cells.areas[k];
    }
    return sum;
}

std::vector<float> blurred(const SurfaceCells& cells, double sigma, std::vector<float> values,
                           int threads = 2) {
    Team team(threads);
    blur_cells(cells, sigma, 1, values, team);
    return values;
}

/// Random values, each 0 or 1.
std::vector<float> coins(std::size_t count) {
    std::vector<float> values;
    for (std::uint32_t k = 0; k < count; ++k) {
        values.push_back(pcg4d({k, 3, 0, 0})[0] & 1 ? 1.0F : 0.0F);
    }
    return values;
}

TEST(BlurCells, SumsStayAndValuesStayInTheirRange) {
    const SurfaceCells cells = cells_of(sphere(12), 3000);
    const std::vector<float> values = coins(3000);
    const double before = total(cells, values);
    double last_spread = 1;
    for (const double sigma : {0.0, 0.5, 1.0, 3.0, 20.0, 200.0}) {
        const std::vector<float> after = blurred(cells, sigma, values);
        EXPECT_NEAR(total(cells, after) / before, 1, 1e-3) << sigma;
        const auto [low, high] = std::minmax_element(after.begin(), after.end());
        EXPECT_GE(*low, -1e-3F) << sigma;
        EXPECT_LE(*high, 1 + 1e-3F) << sigma;
        const double spread = static_cast<double>(*high - *low);
        EXPECT_LE(spread, last_spread) << sigma;
        last_spread = spread;
    }
    EXPECT_LT(last_spread, 0.01);
}

TEST(BlurCells, AWaveLosesWhatAGaussianTakes) {
    const SurfaceMesh mesh = square();
    const SurfaceCells cells = cells_of(mesh, 4000);
    // Nothing flows through the sides, and this cosine has no slope there.
    const double wave = 4 * std::numbers::pi;
    std::vector<float> values;
    for (const SurfacePlace& place : cells.places) {
        values.push_back(static_cast<float>(std::cos(wave * position_of(mesh, place).x)));
    }
    for (const double sigma : {1.0, 3.0, 6.0}) {
        const std::vector<float> after = blurred(cells, sigma, values);
        double above = 0, below = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            above += static_cast<double>(after[k] * values[k]) * cells.areas[k];
            below += static_cast<double>(values[k] * values[k]) * cells.areas[k];
        }
        const double length = sigma * cell_spacing(cells);
        EXPECT_NEAR(above / below, std::exp(-wave * wave * length * length / 2), 0.02) << sigma;
    }
}

TEST(BlurCells, APointBecomesAGaussian) {
    const SurfaceMesh mesh = square();
    const SurfaceCells cells = cells_of(mesh, 4000);
    std::size_t middle = 0;
    const auto from_middle = [&](std::size_t k) {
        return length(position_of(mesh, cells.places[k]) - Vector3d{0.5, 0.5, 0});
    };
    for (std::size_t k = 1; k < 4000; ++k) {
        if (from_middle(k) < from_middle(middle)) middle = k;
    }
    std::vector<float> values(4000);
    values[middle] = 1;
    const double sigma = 4;
    const std::vector<float> after = blurred(cells, sigma, values);
    const double spacing = cell_spacing(cells);
    const double sum = total(cells, after);
    double squares = 0;
    const Vector3d centre = position_of(mesh, cells.places[middle]);
    for (std::size_t k = 0; k < 4000; ++k) {
        const Vector3d apart = (position_of(mesh, cells.places[k]) - centre) * (1 / spacing);
        squares += dot(apart, apart) * static_cast<double>(after[k]) * cells.areas[k] / sum;
    }
    EXPECT_NEAR(squares / 2, sigma * sigma, 0.1 * sigma * sigma);
    const double peak =
        cells.areas[middle] / (2 * std::numbers::pi * sigma * sigma) / (spacing * spacing);
    EXPECT_NEAR(static_cast<double>(after[middle]) / peak, 1, 0.15);
}

TEST(BlurCells, ChannelsAndThreadsDoNotMatter) {
    const SurfaceCells cells = cells_of(box(), 500);
    const std::vector<float> values = coins(500);
    const std::vector<float> one = blurred(cells, 3, values, 1);
    EXPECT_EQ(one, blurred(cells, 3, values, 3));
    std::vector<float> pairs;
    for (const float value : values) pairs.insert(pairs.end(), {1 - value, value});
    Team team(2);
    blur_cells(cells, 3, 2, pairs, team);
    for (std::size_t k = 0; k < 500; ++k) EXPECT_EQ(pairs[2 * k + 1], one[k]);
}

TEST(BlurCells, CellsThatCoincideDoNoHarm) {
    const SurfaceMesh mesh = box();
    std::vector<SurfacePlace> places = even_places(mesh, 300);
    for (std::size_t k = 0; k < 100; ++k) {
        places.push_back(places[k]);
        places.back().weights[0] *= 1 - 1e-9;
    }
    Team team(2);
    const SurfaceCells cells = voronoi_cells(mesh, places, team, never);
    for (const float value : blurred(cells, 10, coins(400))) {
        EXPECT_GE(value, -1e-3F);
        EXPECT_LE(value, 1 + 1e-3F);
    }
}

}  // namespace
}  // namespace cascade::test
