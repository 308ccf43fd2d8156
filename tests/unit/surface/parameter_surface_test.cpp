// Metrics of surfaces that have a formula.
#include "surface/parameter_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

Grid grid_of(std::int64_t width, std::int64_t height) {
    Grid grid;
    grid.width = width;
    grid.height = height;
    return grid;
}

Position torus_position(double sx, double sy) {
    const double out = 3 + std::cos(two_pi * sy);
    return {out * std::cos(two_pi * sx), out * std::sin(two_pi * sx), std::sin(two_pi * sy)};
}

TEST(ParameterSurface, ATorusHasItsMetric) {
    const Grid grid = grid_of(90, 40);
    const auto metric = measure_surface(torus_position, grid, 1.0);
    ASSERT_TRUE(metric);
    double area = 0;
    for (std::int64_t j = 0; j < 40; ++j) {
        const double sy = (static_cast<double>(j) + 0.5) / 40;
        const double along = two_pi * (3 + std::cos(two_pi * sy)) / 90;
        const double around = two_pi / 40;
        for (const std::int64_t i : {0, 41, 89}) {
            EXPECT_NEAR(metric->inverse_11.at(i, j) * along, 1, 1e-6);
            EXPECT_NEAR(metric->inverse_12.at(i, j), 0, 1e-6);
            EXPECT_NEAR(metric->inverse_22.at(i, j) * around, 1, 1e-6);
            EXPECT_NEAR(metric->area.at(i, j) / (along * around), 1, 1e-6);
        }
        area += 90 * static_cast<double>(metric->area.at(0, j));
    }
    EXPECT_NEAR(area, 4 * std::numbers::pi * std::numbers::pi * 3, 1e-4);
}

TEST(ParameterSurface, WithoutAUnitTheMeanCellHasAreaOne) {
    const Grid grid = grid_of(30, 50);
    const auto metric = measure_surface(torus_position, grid, std::nullopt);
    ASSERT_TRUE(metric);
    double area = 0;
    for (std::int64_t j = 0; j < 50; ++j) {
        for (std::int64_t i = 0; i < 30; ++i) area += static_cast<double>(metric->area.at(i, j));
    }
    EXPECT_NEAR(area / 1500, 1, 1e-6);
    EXPECT_NEAR(metric->unit, std::sqrt(12 * std::numbers::pi * std::numbers::pi / 1500), 1e-9);
}

// Taken to the surface by J, Ṽ⁻¹ A Ṽ⁻ᵀ must be A in the tangent plane. For A = 1, J (Ṽ⁻¹ Ṽ⁻ᵀ) Jᵀ
// must be the projection on the tangent plane, so Ṽ⁻¹ Ṽ⁻ᵀ (JᵀJ) = 1.
TEST(ParameterSurface, TheInverseUndoesShear) {
    const auto sheet = [](double sx, double sy) { return Position{4 * sx + 1.5 * sy, 2 * sy, 0}; };
    const auto metric = measure_surface(sheet, grid_of(8, 4), 1.0);
    ASSERT_TRUE(metric);
    const double p = metric->inverse_11.at(3, 2), q = metric->inverse_12.at(3, 2),
                 r = metric->inverse_22.at(3, 2);
    const double m11 = 0.25, m12 = 0.5 * 0.375, m22 = 0.375 * 0.375 + 0.25;
    EXPECT_NEAR((p * p + q * q) * m11 + q * r * m12, 1, 1e-6);
    EXPECT_NEAR((p * p + q * q) * m12 + q * r * m22, 0, 1e-6);
    EXPECT_NEAR(q * r * m11 + r * r * m12, 0, 1e-6);
    EXPECT_NEAR(q * r * m12 + r * r * m22, 1, 1e-6);
    const double area = metric->area.at(3, 2);
    EXPECT_NEAR(area, 0.25, 1e-6);
    EXPECT_NEAR(metric->flow_11.at(3, 2), area * (p * p + q * q), 1e-6);
    EXPECT_NEAR(metric->flow_12.at(3, 2), area * q * r, 1e-6);
    EXPECT_NEAR(metric->flow_22.at(3, 2), area * r * r, 1e-6);
}

TEST(ParameterSurface, PlacesWithoutAreaAreNamed) {
    const auto line = [](double sx, double) { return Position{sx, 2 * sx, 0}; };
    const auto flat = measure_surface(line, grid_of(8, 4), std::nullopt);
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().message,
              "the surface has no area at sx = 0.0625, sy = 0.125 (column 0, row 0)");
    // A fold along sx = 1/2, which is the centre of column 2.
    const auto fold = [](double sx, double sy) {
        return Position{(sx - 0.5) * (sx - 0.5) * (sx - 0.5), sy, 0};
    };
    const auto folded = measure_surface(fold, grid_of(5, 4), std::nullopt);
    ASSERT_FALSE(folded);
    EXPECT_NE(folded.error().message.find("column 2"), std::string::npos);
    const auto undefined = measure_surface(
        [](double sx, double sy) {
            return Position{std::sqrt(sx - 0.5), sy, 0};
        },
        grid_of(8, 4), std::nullopt);
    ASSERT_FALSE(undefined);
    EXPECT_EQ(undefined.error().message,
              "the surface is not finite at sx = 0.0625, sy = 0.125 (column 0, row 0)");
}

}  // namespace
}  // namespace cascade
