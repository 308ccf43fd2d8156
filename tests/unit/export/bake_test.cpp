// Textures baked from cells: the content of texels.
#include "atlas/texture_layout.h"
#include "core/file.h"
#include "core/hash.h"
#include "export/bake.h"
#include "export/fill_gaps.h"
#include "export/glb.h"
#include "mesh/model_file.h"
#include "picture/srgb.h"
#include "unit/export/example_surfaces.h"
#include "unit/export/grey_look.h"
#include "unit/picture/exr_reader.h"
#include "unit/surface/even_cells.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace cascade {
namespace {

using test::flat_square;
using test::grey;
using test::never;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A value in each cell, computed from the position of the cell.
template <typename Function>
std::vector<float> values_of(const SurfaceMesh& mesh, const SurfaceCells& cells,
                             const Function& function) {
    std::vector<float> values;
    for (const SurfacePlace& place : cells.places) {
        values.push_back(static_cast<float>(function(position_of(mesh, place))));
    }
    return values;
}

PaintedCells painted(std::span<const float> values) { return {1, values, grey, {}}; }

Bake baked(const SurfaceMesh& mesh, const SurfaceCells& cells, const PaintedCells& look,
           const BakeOptions& options, int threads = 2) {
    Team team(threads);
    const CellFilter filter(mesh, cells, team);
    Result<Bake> result = bake(mesh, filter, look, options, team, never);
    EXPECT_TRUE(result.has_value()) << result.error().message;
    return std::move(*result);
}

BakeOptions size_of_texture(std::int64_t width, std::int64_t height, int samples = 2) {
    BakeOptions options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    return options;
}

TEST(TextureLayout, EverySampleOfASquareHasOneTriangle) {
    for (const std::uint32_t n : {1u, 3u, 8u}) {
        const SurfaceMesh mesh = flat_square(n);
        const TextureLayout layout(mesh, 24, 16);
        std::vector<std::uint32_t> owners(24 * 16);
        EXPECT_EQ(layout.find_owners(0, 16, owners).again, 0);
        EXPECT_EQ(std::count(owners.begin(), owners.end(), TextureLayout::nothing), 0);
        EXPECT_NEAR(layout.covered_area(), 1, 1e-6);
        for (std::int64_t row = 0; row < 16; ++row) {
            for (std::int64_t column = 0; column < 24; ++column) {
                const SurfacePlace place =
                    layout.place_at(owners[static_cast<std::size_t>(row * 24 + column)], column,
                                    row);
                const Vector3d p = position_of(mesh, place);
                EXPECT_NEAR(p.x, (static_cast<double>(column) + 0.5) / 24, 1e-6);
                EXPECT_NEAR(p.y, 1 - (static_cast<double>(row) + 0.5) / 16, 1e-6);
            }
        }
    }
}

TEST(TextureLayout, RepeatsBeyondItsSides) {
    SurfaceMesh mesh = flat_square(4);
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place = {place[0] - 7.25F, place[1] + 2.5F};
    }
    const TextureLayout layout(mesh, 16, 8);
    std::vector<std::uint32_t> owners(16 * 8);
    EXPECT_EQ(layout.find_owners(0, 8, owners).again, 0);
    EXPECT_EQ(std::count(owners.begin(), owners.end(), TextureLayout::nothing), 0);
    const Vector3d p = position_of(mesh, layout.place_at(owners[0], 0, 0));
    EXPECT_NEAR(p.x, 0.25 + 0.5 / 16, 1e-6);
    EXPECT_NEAR(p.y, 0.5 - 0.5 / 8, 1e-6);
}

TEST(TextureLayout, SkipsWhatHasNoArea) {
    SurfaceMesh mesh = flat_square(2);
    mesh.texture[0].fill({0.5F, 0.5F});
    mesh.texture[1][2][0] = std::numeric_limits<float>::quiet_NaN();
    mesh.texture[2][0][1] = 1e30F;
    const TextureLayout layout(mesh, 8, 8);
    EXPECT_EQ(layout.skipped().without_area, 1u);
    EXPECT_EQ(layout.skipped().without_place, 2u);
}

TEST(FillGaps, GoesOnFromWhatIsThere) {
    PartialTexture texture(13, 7);
    texture.texels[30] = {2, 3, 4};
    texture.is_filled[30] = 1;
    fill_gaps(texture);
    for (const auto& texel : texture.texels) EXPECT_THAT(texel, ElementsAre(2, 3, 4));

    PartialTexture halves(32, 32);
    for (std::size_t k = 0; k < halves.texels.size(); ++k) {
        const std::size_t x = k % 32;
        if (x >= 4 && x < 8) halves.texels[k] = {1, 0, 0};
        if ((x >= 4 && x < 8) || (x >= 20 && x < 24)) halves.is_filled[k] = 1;
    }
    fill_gaps(halves);
    for (std::size_t y = 0; y < 32; ++y) {
        EXPECT_GT(halves.texels[y * 32 + 8][0], 0.8F);
        EXPECT_GT(halves.texels[y * 32 + 3][0], 0.8F);
        EXPECT_LT(halves.texels[y * 32 + 19][0], 0.2F);
        for (std::size_t x = 0; x < 32; ++x) {
            EXPECT_GE(halves.texels[y * 32 + x][0], 0);
            EXPECT_LE(halves.texels[y * 32 + x][0], 1);
        }
    }

    PartialTexture nothing(5, 5);
    fill_gaps(nothing);
    EXPECT_THAT(nothing.texels[7], ElementsAre(0, 0, 0));
}

TEST(Bake, TexelsOfASquareAreWhatThePlacesSay) {
    const SurfaceMesh mesh = flat_square(3);
    const SurfaceCells cells = test::cells_of(mesh, 500);
    const std::vector<float> values = values_of(mesh, cells, [](Vector3d) { return 0; });
    PaintedCells look = painted(values);
    // Each quarter of each texel has its own colour. The mean must be computed in linear light.
    look.colour = [&](std::span<const float>, const SurfacePlace& place) -> Colour {
        const Vector3d p = position_of(mesh, place);
        const bool is_left = p.x * 16 - std::floor(p.x * 16) < 0.5;
        return {static_cast<float>(p.x), static_cast<float>(p.y), is_left ? 1.0F : 0.0F};
    };
    const Bake result = baked(mesh, cells, look, size_of_texture(16, 16));
    EXPECT_THAT(result.warnings, IsEmpty());
    EXPECT_EQ(result.covered, 1);
    EXPECT_EQ(result.overlapping, 0);
    EXPECT_THAT(result.relief.pixels, IsEmpty());
    for (std::int64_t y = 0; y < 16; ++y) {
        for (std::int64_t x = 0; x < 16; ++x) {
            const Colour& texel = result.colour.at(x, y);
            const auto light = [](double place) {
                return (light_of(static_cast<float>(place - 0.25 / 16)) +
                        light_of(static_cast<float>(place + 0.25 / 16))) /
                       2;
            };
            EXPECT_NEAR(light_of(texel[0]), light((static_cast<double>(x) + 0.5) / 16), 1e-5F);
            EXPECT_NEAR(light_of(texel[1]), light(1 - (static_cast<double>(y) + 0.5) / 16), 1e-5F);
            EXPECT_NEAR(light_of(texel[2]), 0.5F, 1e-5F);
        }
    }
}

TEST(Bake, ConstantsStayAndLinearFunctionsNearly) {
    const SurfaceMesh mesh = flat_square(5);
    const SurfaceCells cells = test::cells_of(mesh, 3000);
    std::vector<float> values;
    for (const float x : values_of(mesh, cells, [](Vector3d p) { return p.x; })) {
        values.insert(values.end(), {x, 0.1F});
    }
    PaintedCells look;
    look.channels = 2;
    look.values = values;
    look.colour = [](std::span<const float> at, const SurfacePlace&) -> Colour {
        return {at[0], at[1], 0};
    };
    const Bake result = baked(mesh, cells, look, size_of_texture(64, 64));
    for (std::int64_t x = 8; x < 56; ++x) {
        EXPECT_NEAR(result.colour.at(x, 32)[0], (static_cast<double>(x) + 0.5) / 64, 0.012);
        EXPECT_NEAR(result.colour.at(x, 32)[1], 0.1F, 1e-5F);
    }
}

/// A sphere with a pattern that is smooth across the seam.
struct BakedSphere {
    SurfaceMesh mesh = test::sphere_with_texture(24);
    SurfaceCells cells = test::cells_of(mesh, 4000);
    std::vector<float> values = values_of(mesh, cells, [](Vector3d p) {
        return 0.5 + 0.4 * std::sin(5 * p.x) * std::cos(4 * p.y + 3 * p.z);
    });
    PaintedCells look = {1, values, grey, values};
};

TEST(Bake, EveryTexelIsNearlyWhatTheFilterSaysThere) {
    const BakedSphere sphere;
    const std::int64_t width = 1024, height = 512;
    const Bake result =
        baked(sphere.mesh, sphere.cells, sphere.look, size_of_texture(width, height, 1));
    Team team(1);
    const CellFilter filter(sphere.mesh, sphere.cells, team);
    PlacePainter painter(filter, sphere.look);
    const TextureLayout layout(sphere.mesh, width, height);
    std::vector<std::uint32_t> owners(static_cast<std::size_t>(width * height));
    layout.find_owners(0, height, owners);
    float largest = 0;
    for (std::int64_t y = 0; y < height; ++y) {
        for (std::int64_t x = 0; x < width; ++x) {
            const std::uint32_t owner = owners[static_cast<std::size_t>(y * width + x)];
            if (owner == TextureLayout::nothing) continue;
            const float exact = painter.at(layout.place_at(owner, x, y)).colour[0];
            largest = std::max(largest, std::abs(result.colour.at(x, y)[0] - exact));
        }
    }
    EXPECT_LT(largest, 0.5F / 255);
    EXPECT_GT(largest, 0) << "values are interpolated";
}

TEST(Bake, BothSidesOfASeamAgree) {
    const BakedSphere sphere;
    const Bake result = baked(sphere.mesh, sphere.cells, sphere.look, size_of_texture(256, 128));
    double largest = 0, steps = 0;
    for (std::int64_t y = 8; y < 120; ++y) {
        const auto step = [&](std::int64_t x) {
            return std::abs(static_cast<double>(result.colour.at(x, y)[0]) -
                            static_cast<double>(result.colour.at((x + 1) % 256, y)[0]));
        };
        largest = std::max(largest, step(255));
        for (std::int64_t x = 0; x < 255; ++x) steps = std::max(steps, step(x));
    }
    EXPECT_LE(largest, steps);
    EXPECT_GT(steps, 0.005);
}

TEST(Bake, TheMeanColourIsThatOfTheCells) {
    const BakedSphere sphere;
    const Bake result = baked(sphere.mesh, sphere.cells, sphere.look, size_of_texture(256, 128));
    double sum = 0, weights = 0, cells = 0, areas = 0;
    for (std::int64_t y = 0; y < 128; ++y) {
        const double weight = std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / 128);
        for (std::int64_t x = 0; x < 256; ++x) {
            sum += weight * static_cast<double>(result.colour.at(x, y)[0]);
            weights += weight;
        }
    }
    for (std::size_t k = 0; k < sphere.cells.places.size(); ++k) {
        cells += sphere.cells.areas[k] * static_cast<double>(sphere.values[k]);
        areas += sphere.cells.areas[k];
    }
    EXPECT_NEAR(sum / weights, cells / areas, 0.002);
    EXPECT_NEAR(result.covered, 1 - 1.0 / 24,
                0.002);  // Half of each column is empty beside the triangles at the poles.
}

TEST(Bake, TheSameOnAnyNumberOfThreads) {
    const BakedSphere sphere;
    const Bake one = baked(sphere.mesh, sphere.cells, sphere.look, size_of_texture(97, 61, 3), 1);
    const Bake three = baked(sphere.mesh, sphere.cells, sphere.look, size_of_texture(97, 61, 3), 3);
    EXPECT_EQ(one.colour.pixels, three.colour.pixels);
    EXPECT_EQ(one.relief.pixels, three.relief.pixels);
    EXPECT_EQ(one.normals.pixels, three.normals.pixels);
    EXPECT_EQ(one.covered, three.covered);
}

TEST(Bake, NormalsLeanAwayFromWhatRises) {
    SurfaceMesh mesh = flat_square(4);
    const SurfaceCells cells = test::cells_of(mesh, 4000);
    const std::vector<float> heights =
        values_of(mesh, cells, [](Vector3d p) { return 0.3 * p.x - 0.2 * p.y; });
    const PaintedCells look{1, heights, grey, heights};
    const auto middle = [&] {
        const Bake result = baked(mesh, cells, look, size_of_texture(64, 64));
        Vector3d sum;
        for (std::int64_t y = 24; y < 40; ++y) {
            for (std::int64_t x = 24; x < 40; ++x) {
                const Colour& texel = result.normals.at(x, y);
                sum = sum + Vector3d{2.0 * texel[0] - 1, 2.0 * texel[1] - 1, 2.0 * texel[2] - 1};
            }
        }
        return unit(sum);
    };
    const Vector3d wanted = unit(Vector3d{-0.3, 0.2, 1});
    EXPECT_LT(length(middle() - wanted), 0.02);
    // In a mirrored texture the first tangent is reversed.
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place[0] = 1 - place[0];
    }
    EXPECT_LT(length(middle() - Vector3d{-wanted.x, wanted.y, wanted.z}), 0.02);
    // A quarter turn: u is y and v is −x.
    mesh = flat_square(4);
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place = {place[1], 1 - place[0]};
    }
    EXPECT_LT(length(middle() - Vector3d{wanted.y, -wanted.x, wanted.z}), 0.02);
}

TEST(Bake, LevelGroundIsLevelAndNaNIsTakenFromAround) {
    const SurfaceMesh mesh = flat_square(2);
    const SurfaceCells cells = test::cells_of(mesh, 400);
    std::vector<float> values = values_of(mesh, cells, [](Vector3d) { return 1e6 / 3; });
    const PaintedCells look = {1, values, grey, values};
    const Bake level = baked(mesh, cells, look, size_of_texture(32, 32));
    for (const Colour& texel : level.normals.pixels) EXPECT_THAT(texel, ElementsAre(0.5F, 0.5F, 1));
    for (std::size_t k = 0; k < 40; ++k) {
        values[k * 10] = k % 2 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                    : std::numeric_limits<float>::infinity();
    }
    const Bake holes = baked(mesh, cells, look, size_of_texture(32, 32));
    for (const Colour& texel : holes.normals.pixels) EXPECT_NEAR(texel[2], 1, 1e-6F);
    for (const Colour& texel : holes.relief.pixels) {
        EXPECT_GE(texel[0], 0);
        EXPECT_LE(texel[0], 1);
    }
    EXPECT_NEAR(holes.heights.low, 1e6F / 3, 1);
    EXPECT_EQ(holes.colour.at(0, 0).size(), 3u);
    std::fill(values.begin(), values.end(), std::numeric_limits<float>::quiet_NaN());
    const Bake nothing = baked(mesh, cells, look, size_of_texture(8, 8));
    EXPECT_EQ(nothing.heights.high, 0);
    for (const Colour& texel : nothing.normals.pixels)
        EXPECT_THAT(texel, ElementsAre(0.5F, 0.5F, 1));
    for (const Colour& texel : nothing.colour.pixels) EXPECT_THAT(texel, ElementsAre(1, 0, 1));
}

TEST(Bake, MarginsGoOnFromThePartsOfTheModel) {
    SurfaceMesh mesh = flat_square(4);
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place = {0.25F + place[0] / 2, 0.25F + place[1] / 2};
    }
    const SurfaceCells cells = test::cells_of(mesh, 300);
    const std::vector<float> values = values_of(mesh, cells, [](Vector3d) { return 0.75; });
    const PaintedCells look = painted(values);
    const Bake result = baked(mesh, cells, look, size_of_texture(50, 50));
    EXPECT_NEAR(result.covered, 0.25, 0.02);
    for (const Colour& texel : result.colour.pixels) EXPECT_NEAR(texel[0], 0.75, 1e-4);
}

TEST(Bake, SaysHowMuchOverlaps) {
    SurfaceMesh mesh = flat_square(4);
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place[0] = std::min(place[0], 1 - place[0]);
    }
    const SurfaceCells cells = test::cells_of(mesh, 100);
    const std::vector<float> values = values_of(mesh, cells, [](Vector3d) { return 0; });
    const PaintedCells look = painted(values);
    const Bake result = baked(mesh, cells, look, size_of_texture(32, 32));
    EXPECT_NEAR(result.overlapping, 0.5, 1e-9);
    EXPECT_THAT(result.warnings,
                ElementsAre("50.0 % of the texture belongs to several parts of the model, one of "
                            "them mirrored, as the two halves of a body may be: 50.0 % of the "
                            "model shows the pattern of another part; --unwrap gives each part "
                            "another place in the texture"));
}

TEST(Bake, RefusesWhatCannotBePainted) {
    SurfaceMesh mesh = flat_square(2);
    const SurfaceCells cells = test::cells_of(mesh, 20);
    const std::vector<float> values = values_of(mesh, cells, [](Vector3d) { return 0; });
    const PaintedCells look = painted(values);
    Team team(2);
    const CellFilter filter(mesh, cells, team);
    const auto message = [&] {
        const Result<Bake> result = bake(mesh, filter, look, size_of_texture(16, 16), team, never);
        EXPECT_FALSE(result.has_value());
        return result.error().message + ": " + result.error().hint;
    };
    const auto texture = mesh.texture;
    mesh.texture.clear();
    EXPECT_THAT(message(), HasSubstr("no texture coordinates to paint by: use --unwrap"));
    mesh.texture.assign(mesh.triangles.size(), {});
    EXPECT_THAT(message(), HasSubstr("have no area in the texture: use --unwrap to make new ones"));
    mesh.texture = texture;
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place = {place[0] * 0.01F, place[1] * 0.01F};
    }
    EXPECT_THAT(message(), HasSubstr("have no area in the texture"));
    EXPECT_TRUE(check_bakeable(mesh));  // Larger maps have samples inside the triangles.
    mesh.texture = texture;
    for (auto& corners : mesh.texture) {
        for (TexturePlace& place : corners) place = {place[0] * 9, place[1] * 9};
    }
    EXPECT_THAT(message(), HasSubstr("cover the texture 81 times over: they are meant for"));
}

TEST(Bake, AnyTextureCoordinatesAndValuesMakeFilesOrAFault) {
    const float odd[] = {0,
                         1,
                         0.5F,
                         -0.0F,
                         1e-40F,
                         300,
                         -7.25F,
                         1e30F,
                         3e38F,
                         std::numeric_limits<float>::quiet_NaN(),
                         -std::numeric_limits<float>::infinity()};
    std::size_t painted_ones = 0;
    const SurfaceCells cells = test::cells_of(test::sphere_with_texture(4), 50);
    Team team(2);
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        SurfaceMesh mesh = test::sphere_with_texture(4);
        std::uint32_t drawn = 0;
        const auto next = [&](std::size_t below) {
            return pcg4d({seed, drawn++, 0, 0})[0] % static_cast<std::uint32_t>(below);
        };
        for (auto& corners : mesh.texture) {
            for (TexturePlace& place : corners) {
                for (float& number : place) {
                    if (next(seed % 20 + 1) == 0) number = odd[next(std::size(odd))];
                }
            }
        }
        std::vector<float> values(50);
        for (float& value : values) value = odd[next(std::size(odd))];
        const CellFilter filter(mesh, cells, team);
        const PaintedCells look{1, values, grey, values};
        const Result<Bake> result = bake(mesh, filter, look, size_of_texture(17, 9), team, never);
        if (!result) continue;
        ++painted_ones;
        for (const Image* map : {&result->colour, &result->relief, &result->normals}) {
            for (const Colour& texel : map->pixels) {
                for (const float level : texel) EXPECT_TRUE(level >= 0 && level <= 1) << level;
            }
        }
        EXPECT_TRUE(read_gltf(*encode_glb(mesh, {})).has_value());
    }
    EXPECT_GT(painted_ones, 20u);
}

TEST(Bake, FilesAreAModelAndItsMaps) {
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / "cascade_baked";
    std::filesystem::create_directories(folder);
    const BakedSphere sphere;
    Bake result = baked(sphere.mesh, sphere.cells, sphere.look, size_of_texture(64, 32));
    const std::filesystem::path model = folder / "a.b.glb";
    ASSERT_TRUE(write_maps(model, sphere.mesh, result, {{"Software", "Cascade"}}).has_value());
    EXPECT_THAT(map_paths(model, {.heights = true, .normals = true}),
                ElementsAre(model, folder / "a.b_color.png", folder / "a.b_height.png",
                            folder / "a.b_normal.png"));
    // Only the map of colours has an sRGB chunk. All maps have the range of heights as text.
    for (const char* name : {"a.b_color.png", "a.b_height.png", "a.b_normal.png"}) {
        const std::string bytes = read_file(folder / name, 1u << 30).value();
        const bool is_colour = std::string_view(name) == "a.b_color.png";
        EXPECT_EQ(bytes.find("sRGB") != std::string::npos, is_colour) << name;
        EXPECT_EQ(int{bytes[24]}, is_colour ? 8 : 16) << name;  // The bit depth.
        EXPECT_EQ(parse_png_texts(bytes)->at("Cascade heights"),
                  fmt::format("{:.9g} {:.9g}", result.heights.low, result.heights.high));
    }
    for (const auto& path : map_paths(model, {.heights = true, .normals = true})) {
        EXPECT_TRUE(std::filesystem::remove(path)) << path;
    }
    // The same maps as OpenEXR: heights in lengths, colours in linear light.
    ASSERT_TRUE(write_maps(model, sphere.mesh, result, {}, MapFormat::exr).has_value());
    EXPECT_FALSE(std::filesystem::exists(folder / "a.b_color.png"));
    const test::ReadExr heights = test::read_exr(folder / "a.b_height.exr");
    EXPECT_EQ(heights.names, std::vector<std::string>{"Y"});
    EXPECT_TRUE(heights.half.empty());
    const auto [least, most] =
        std::minmax_element(heights.numbers[0].begin(), heights.numbers[0].end());
    EXPECT_FLOAT_EQ(*least, result.heights.low);
    EXPECT_FLOAT_EQ(*most, result.heights.high);
    const test::ReadExr colours = test::read_exr(folder / "a.b_color.exr");
    ASSERT_EQ(colours.names, (std::vector<std::string>{"B", "G", "R"}));
    EXPECT_EQ(colours.width, 64);
    EXPECT_EQ(colours.height, 32);
    for (std::size_t k = 0; k < result.colour.pixels.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(colours.numbers[2 - c][k], light_of(result.colour.pixels[k][c]), 1e-3);
        }
    }
    result.relief = result.normals = {};
    result.maps = {};
    ASSERT_TRUE(write_maps(model, sphere.mesh, result, {}).has_value());
    const Result<PolygonSoup> read = read_model(model);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->texture.size(), 3 * sphere.mesh.triangles.size());
    EXPECT_FALSE(std::filesystem::exists(folder / "a.b_height.png"));
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace cascade
