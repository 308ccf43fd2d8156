// The material of grids on surfaces: slopes of heights, and interpolated numbers.
#include "run/pictures/surface_finish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::test {
namespace {

constexpr std::int64_t columns = 8, rows = 4;

GridMaterial material_of(std::vector<float> heights) {
    GridMaterial grid{{}, columns, rows};
    grid.material.heights = std::move(heights);
    grid.unit = 0.1;
    return grid;
}

/// Heights that rise by 1 from column to column.
std::vector<float> stairs() {
    std::vector<float> heights;
    for (int k = 0; k < columns * rows; ++k) heights.push_back(static_cast<float>(k % columns));
    return heights;
}

Look look_at(const SurfaceFunction& surface, const GridMaterial& grid, double s, double t) {
    const TriangleMesh mesh =
        surface_lattice(surface, {64, 64, grid.is_periodic_x, grid.is_periodic_y});
    Look look;
    SurfaceFinish(surface, grid, mesh)
        .add_to(look, BetweenCells(s, columns, grid.is_periodic_x),
                BetweenCells(t, rows, grid.is_periodic_y));
    return look;
}

TEST(SurfaceFinish, TiltsBySlopesInSpace) {
    // Over 8 columns heights rise by 8 · 0.1. The sheet is 2 wide, so the slope is 0.4.
    const SurfaceFunction sheet = [](double s, double t) { return Position{2 * s, t + s, 0}; };
    const Look look = look_at(sheet, material_of(stairs()), 0.5, 0.5);
    // The height does not change along y, so its gradient is along x, though the rows are slanted.
    EXPECT_NEAR(look.tilt.x, -0.4, 1e-5);
    EXPECT_NEAR(look.tilt.y, 0, 1e-5);
    EXPECT_NEAR(look.tilt.z, 0, 1e-5);
}

TEST(SurfaceFinish, RaisesTheOuterSide) {
    using std::numbers::pi;
    const SurfaceFunction tube = [](double s, double t) {
        return Position{std::cos(2 * pi * s), std::sin(2 * pi * s), 3 * t};
    };
    const SurfaceFunction turned = [&](double s, double t) { return tube(s, 1 - t); };
    // Both meshes have the same ridge along the tube, but opposite normals.
    std::vector<float> ridge(columns * rows, 0.0F);
    for (int row = 0; row < rows; ++row) ridge[static_cast<std::size_t>(row * columns + 2)] = 1;
    GridMaterial grid = material_of(ridge);
    grid.is_periodic_x = true;
    const Look one = look_at(tube, grid, 0.25, 0.5), other = look_at(turned, grid, 0.25, 0.5);
    EXPECT_GT(std::abs(one.tilt.x), 0.01F);
    EXPECT_NEAR(one.tilt.x, -other.tilt.x, 1e-5);
    EXPECT_NEAR(one.tilt.y, -other.tilt.y, 1e-5);
}

TEST(SurfaceFinish, InterpolatesItsNumbers) {
    const SurfaceFunction sheet = [](double s, double t) { return Position{s, t, 0}; };
    GridMaterial grid = material_of({});
    std::vector<float> half(columns * rows, 0.0F);
    for (std::size_t k = 0; k < half.size(); ++k) half[k] = k % columns < columns / 2 ? 0.0F : 1.0F;
    for (const MaterialPart part : {MaterialPart::red, MaterialPart::green, MaterialPart::blue,
                                    MaterialPart::metalness, MaterialPart::opacity}) {
        grid.material.parts[part] = half;
    }
    EXPECT_EQ(look_at(sheet, grid, 0.2, 0.5).glow[1], 0);
    EXPECT_EQ(look_at(sheet, grid, 0.8, 0.5).glow[1], 1);
    EXPECT_FLOAT_EQ(look_at(sheet, grid, 0.5, 0.5).gloss.metalness, 0.5);
    const TriangleMesh mesh = surface_lattice(sheet, {8, 8, false, false});
    const auto opacity = [&](const GridMaterial& of, double s) {
        return SurfaceFinish(sheet, of, mesh)
            .opacity(BetweenCells(s, columns, false), BetweenCells(0.5, rows, false));
    };
    EXPECT_EQ(opacity(grid, 0.49), 0);
    EXPECT_EQ(opacity(grid, 0.51), 1);
    grid.material.parts[MaterialPart::opacity][0] = 0.25F;
    EXPECT_FLOAT_EQ(opacity(grid, 0.5), 0.5);
}

}  // namespace
}  // namespace cascade::test
