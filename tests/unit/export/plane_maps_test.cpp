// Maps of a plane: the content of texels, and that maps repeat without a seam.
#include "export/plane_maps.h"
#include "picture/srgb.h"
#include "unit/export/grey_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace cascade {
namespace {

using test::grey;

MaterialMaps baked(const FlatCells& cells, const PaintedCells& painted, std::int64_t texels,
                   int threads = 2) {
    Team team(threads);
    return bake_plane(cells, painted, texture_size(cells, texels), team);
}

template <typename Function>
std::vector<float> values_of(const FlatCells& cells, const Function& function) {
    std::vector<float> values;
    for (std::int64_t j = 0; j < cells.rows; ++j) {
        for (std::int64_t i = 0; i < cells.columns; ++i) {
            values.push_back(static_cast<float>(function(i, j)));
        }
    }
    return values;
}

/// A periodic pattern with sharp edges, for all maps.
struct Pattern {
    explicit Pattern(std::int64_t shift = 0) {
        values = values_of(cells, [&](std::int64_t i, std::int64_t j) {
            const double x = 2 * std::numbers::pi * static_cast<double>((i + shift) % 24) / 24;
            const double y = 2 * std::numbers::pi * static_cast<double>(j) / 16;
            return 0.5 + 0.4 * std::sin(2 * x + std::cos(y)) * std::cos(3 * y);
        });
        for (const float value : values) {
            sharp.push_back(value > 0.5F ? 1.0F : 0.0F);
            heights.push_back(3 * value);
        }
        painted = {1, values, grey, heights};
        painted.material[MaterialPart::occlusion] = values;
        painted.material[MaterialPart::roughness] = sharp;
        painted.material[MaterialPart::metalness] = values;
        painted.material[MaterialPart::opacity] = sharp;
        for (const auto part : {MaterialPart::red, MaterialPart::green, MaterialPart::blue}) {
            painted.material[part] = part == MaterialPart::green ? sharp : values;
        }
    }
    FlatCells cells{24, 16};
    std::vector<float> values, sharp, heights;
    PaintedCells painted;
};

std::vector<const Image*> images_of(const MaterialMaps& maps) {
    return {&maps.colour,  &maps.relief,   &maps.normals,
            &maps.surface, &maps.emission, &maps.opacity};
}

TEST(PlaneMaps, TheLongerSideHasTheTexelsThatAreAskedFor) {
    using Size = std::array<std::int64_t, 2>;
    EXPECT_EQ(texture_size({64, 64}, 4096), (Size{4096, 4096}));
    EXPECT_EQ(texture_size({24, 16}, 48), (Size{48, 32}));
    EXPECT_EQ(texture_size({10, 30}, 100), (Size{33, 100}));
    EXPECT_EQ(texture_size({100, 1}, 8), (Size{8, 1}));
}

// If the plane is shifted by three cells, the texture is only shifted, so its sides are like all
// other positions.
TEST(PlaneMaps, APeriodicPlaneHasNoSeam) {
    const Pattern here, moved(3);
    const MaterialMaps one = baked(here.cells, here.painted, 120);
    const MaterialMaps other = baked(moved.cells, moved.painted, 120);
    const auto a = images_of(one), b = images_of(other);
    for (std::size_t k = 0; k < a.size(); ++k) {
        ASSERT_EQ(a[k]->width, 120) << k;
        ASSERT_EQ(a[k]->height, 80) << k;
        for (std::int64_t y = 0; y < 80; ++y) {
            for (std::int64_t x = 0; x < 120; ++x) {
                for (std::size_t c = 0; c < 3; ++c) {
                    // Positions between cells are rounded differently.
                    EXPECT_NEAR(b[k]->at(x, y)[c], a[k]->at((x + 15) % 120, y)[c], 2e-5) << k;
                }
            }
        }
    }
}

/// The largest difference between neighbouring columns inside, and the largest difference between
/// the first and the last column.
std::array<double, 2> largest_jumps(const Image& image) {
    std::array<double, 2> jumps{};
    for (std::int64_t x = 0; x < image.width; ++x) {
        for (std::int64_t y = 0; y < image.height; ++y) {
            const Colour &a = image.at(x, y), &b = image.at((x + 1) % image.width, y);
            double& jump = jumps[x + 1 == image.width ? 1 : 0];
            for (std::size_t c = 0; c < 3; ++c) {
                jump = std::max(jump, std::abs(static_cast<double>(a[c] - b[c])));
            }
        }
    }
    return jumps;
}

TEST(PlaneMaps, NoJumpIsLargerAcrossASideThatRepeats) {
    const Pattern pattern;
    const MaterialMaps maps = baked(pattern.cells, pattern.painted, 333);
    for (const Image* image : images_of(maps)) {
        const auto [inside, across] = largest_jumps(*image);
        EXPECT_LE(across, inside);
    }
    // Without periodic sides, the two sides do not influence each other.
    FlatCells cells{24, 16, 1, {false, true}};
    const auto ramp =
        values_of(cells, [](std::int64_t i, std::int64_t) { return static_cast<double>(i) / 23; });
    const auto [inside, across] = largest_jumps(baked(cells, {1, ramp, grey, {}}, 96).colour);
    EXPECT_GT(across, 10 * inside);
}

TEST(PlaneMaps, PartsArePackedAsGltfHasThem) {
    const FlatCells cells{8, 8};
    const std::vector<float> dark(64, 0.25F), rough(64, 0.75F), metal(64, 1.0F), clear(64, 0.5F);
    PaintedCells painted = {1, dark, grey, {}};
    painted.material[MaterialPart::roughness] = rough;
    painted.material[MaterialPart::metalness] = metal;
    painted.material[MaterialPart::opacity] = clear;
    const MaterialMaps maps = baked(cells, painted, 16);
    EXPECT_EQ(maps.surface.at(5, 7), (Colour{1, 0.75F, 1}));  // There is no occlusion.
    EXPECT_EQ(maps.opacity.at(5, 7), (Colour{0.5F, 0.5F, 0.5F}));
    EXPECT_NEAR(maps.colour.at(5, 7)[0], 0.25, 1e-4);
    EXPECT_TRUE(maps.relief.pixels.empty() && maps.normals.pixels.empty());
    EXPECT_TRUE(maps.emission.pixels.empty());
    EXPECT_TRUE(maps.maps.roughness && maps.maps.metalness && maps.maps.opacity);
    EXPECT_FALSE(maps.maps.occlusion || maps.maps.emission || maps.maps.heights || maps.is_cut);
    const std::vector<float> holes =
        values_of(cells, [](std::int64_t i, std::int64_t) { return i % 2; });
    painted.material[MaterialPart::opacity] = holes;
    EXPECT_TRUE(baked(cells, painted, 16).is_cut);
}

TEST(PlaneMaps, EmissionIsMixedAsLight) {
    const FlatCells cells{2, 1, 1, {false, false}};
    const std::vector<float> values = {0, 1};
    PaintedCells painted = {1, values, grey, {}};
    for (const auto part : {MaterialPart::red, MaterialPart::green, MaterialPart::blue}) {
        painted.material[part] = values;
    }
    const MaterialMaps maps = baked(cells, painted, 1);  // Both cells in one texel.
    EXPECT_EQ(maps.emission.at(0, 0), maps.colour.at(0, 0));
    EXPECT_GT(maps.emission.at(0, 0)[0], 0.6F);  // sRGB of half the light is 0.735.
}

TEST(PlaneMaps, NormalsAreThoseOfTheHeights) {
    const FlatCells cells{32, 32, 0.5};
    const double wave = 2 * std::numbers::pi / 16;  // The wavelength is half the side, 16 cells.
    const auto heights = values_of(cells, [&](std::int64_t i, std::int64_t) {
        return std::sin(wave * (static_cast<double>(i) + 0.5) * cells.side * 2);
    });
    const std::vector<float> even(32 * 32, 0.5F);
    const MaterialMaps maps = baked(cells, {1, even, grey, heights}, 256);
    EXPECT_NEAR(maps.heights.low, -1, 0.01);
    EXPECT_NEAR(maps.heights.high, 1, 0.01);
    for (std::int64_t x = 0; x < 256; x += 3) {
        const double place = (static_cast<double>(x) + 0.5) / 256 * 16;
        const double slope = 2 * wave * std::cos(2 * wave * place);
        const double size = std::sqrt(1 + slope * slope);
        const Colour normal = maps.normals.at(x, 100);
        EXPECT_NEAR(2 * normal[0] - 1, -slope / size, 0.05) << x;
        EXPECT_NEAR(2 * normal[1] - 1, 0, 1e-6) << x;
        EXPECT_NEAR(2 * normal[2] - 1, 1 / size, 0.05) << x;
        EXPECT_NEAR(maps.relief.at(x, 100)[0], 0.5 + 0.5 * std::sin(2 * wave * place), 0.02) << x;
    }
}

// Green is larger where the surface faces upwards in the picture, also at sides that are not
// periodic.
TEST(PlaneMaps, GreenIsUp) {
    const FlatCells cells{8, 8, 1, {false, false}};
    const auto heights =
        values_of(cells, [](std::int64_t, std::int64_t j) { return static_cast<double>(j); });
    const std::vector<float> even(64, 0.5F);
    const MaterialMaps maps = baked(cells, {1, even, grey, heights}, 64);
    for (const std::int64_t y : {20, 32, 40}) {
        const Colour normal = maps.normals.at(30, y);
        EXPECT_NEAR(2 * normal[1] - 1, std::sqrt(0.5), 0.02) << y;
        EXPECT_NEAR(2 * normal[0] - 1, 0, 1e-6);
    }
}

TEST(PlaneMaps, ValuesStayInRangeAtEdges) {
    std::mt19937 random(3);
    const FlatCells cells{16, 16};
    std::vector<float> sharp;
    for (int k = 0; k < 256; ++k) sharp.push_back(random() % 2 == 0 ? 0.2F : 0.8F);
    PaintedCells painted = {1, sharp, grey, sharp};
    const MaterialMaps maps = baked(cells, painted, 160);
    // Interpolated values may leave the range of the cells a little at single cells of noise, but
    // not at straight edges.
    EXPECT_GE(maps.heights.low, 0.2F - 0.06F * 0.6F);
    EXPECT_LE(maps.heights.high, 0.8F + 0.06F * 0.6F);
    std::vector<float> half(256, 0.2F);
    for (std::size_t k = 0; k < 128; ++k) half[k] = 0.8F;
    const MaterialMaps step = baked(cells, {1, half, grey, half}, 160);
    EXPECT_EQ(step.heights.low, 0.2F);
    EXPECT_EQ(step.heights.high, 0.8F);
}

TEST(PlaneMaps, SmallTexturesHoldTheMean) {
    const FlatCells cells{64, 64};
    const auto stripes = values_of(cells, [](std::int64_t i, std::int64_t) { return i % 2; });
    PaintedCells painted = {1, stripes, grey, {}};
    painted.material[MaterialPart::roughness] = stripes;
    const MaterialMaps maps = baked(cells, painted, 8);
    for (const Colour& texel : maps.surface.pixels) EXPECT_NEAR(texel[1], 0.5, 0.01);
    for (const Colour& texel : maps.colour.pixels) EXPECT_NEAR(texel[0], stored_of(0.5F), 0.03);
}

TEST(PlaneMaps, CellsOutsideTakeAfterThoseBeside) {
    FlatCells cells{16, 16};
    std::vector<float> values(256, 0.0F), opacity(256, 0.0F);
    cells.inside.assign(256, 0);
    for (std::size_t k = 0; k < 256; ++k) {
        if (k % 16 >= 8) continue;
        cells.inside[k] = 1;
        values[k] = 0.6F;
        opacity[k] = 1;
    }
    PaintedCells painted = {1, values, grey, values};
    painted.material[MaterialPart::opacity] = opacity;
    const MaterialMaps maps = baked(cells, painted, 64);
    for (const Colour& texel : maps.colour.pixels) EXPECT_NEAR(texel[0], 0.6, 1e-3);
    EXPECT_NEAR(maps.heights.low, 0.6, 1e-6);
    EXPECT_EQ(maps.opacity.at(16, 30)[0], 1);
    EXPECT_EQ(maps.opacity.at(48, 30)[0], 0);
    EXPECT_TRUE(maps.is_cut);
}

TEST(PlaneMaps, NaNIsMagentaInColoursAndFilledInHeights) {
    const FlatCells cells{8, 8};
    std::vector<float> values(64, 0.5F);
    values[8 * 4 + 4] = std::numeric_limits<float>::quiet_NaN();
    const MaterialMaps maps = baked(cells, {1, values, grey, values}, 8);
    EXPECT_EQ(maps.colour.at(4, 4), (Colour{1, 0, 1}));
    EXPECT_NEAR(maps.colour.at(0, 0)[0], 0.5, 1e-4);
    EXPECT_EQ(maps.heights.low, 0.5F);
    EXPECT_EQ(maps.heights.high, 0.5F);
    for (const Colour& texel : maps.relief.pixels) EXPECT_EQ(texel[0], 0.5F);
    const std::vector<float> nothing(64, std::numeric_limits<float>::infinity());
    EXPECT_EQ(baked(cells, {1, values, grey, nothing}, 8).heights.high, 0);
}

TEST(PlaneMaps, ThreadsChangeNothing) {
    const Pattern pattern;
    const MaterialMaps one = baked(pattern.cells, pattern.painted, 77, 1);
    const MaterialMaps five = baked(pattern.cells, pattern.painted, 77, 5);
    const auto a = images_of(one), b = images_of(five);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k]->pixels, b[k]->pixels) << k;
}

TEST(PlaneMaps, TheRectangleHasThePlanesSize) {
    const SurfaceMesh mesh = plane_mesh({30, 20, 0.1});
    EXPECT_NEAR(mesh.total_area(), 6, 1e-12);
    EXPECT_GT(mesh.double_area_normal(0).z, 0);
    EXPECT_GT(mesh.double_area_normal(1).z, 0);
    for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
        for (std::uint32_t edge = 0; edge < 3; ++edge) {
            const TriangleEdge other = mesh.across[triangle][edge];
            if (!other.exists()) continue;
            EXPECT_EQ(mesh.across[other.triangle][other.edge], (TriangleEdge{triangle, edge}));
            EXPECT_EQ(mesh.triangles[other.triangle][other.edge],
                      mesh.triangles[triangle][corner_after(edge)]);
        }
    }
}

}  // namespace
}  // namespace cascade
