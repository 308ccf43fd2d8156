// Levels of detail look like the model: its colours from afar, its normals, its maps.
#include "export/levels.h"

#include "atlas/unwrap.h"
#include "export/bake.h"
#include "export/glb.h"
#include "export/level_samples.h"
#include "mesh/animals.h"
#include "mesh/model_file.h"
#include "mesh/shapes.h"
#include "mesh/simplify.h"
#include "picture/srgb.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace cascade {
namespace {

using test::never;

/// Black and white bands across x.
ModelLevel banded(SurfaceMesh mesh, double bands) {
    ModelLevel level;
    level.channels.push_back({"x", {}});
    for (const Vector3d& p : mesh.points) {
        const float grey = std::sin(bands * p.x) > 0 ? 1.0F : 0.0F;
        level.colours.push_back({grey, grey, grey});
        level.channels[0].values.push_back(static_cast<float>(p.x));
    }
    level.mesh = std::move(mesh);
    return level;
}

/// The mean over the surface of a number at each point.
template <typename Take>
double mean_over(const SurfaceMesh& mesh, const Take& number) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t p : mesh.triangles[t]) {
            sum += mesh.area(t) / 3 * static_cast<double>(number(p));
        }
    }
    return sum / mesh.total_area();
}

std::vector<ModelLevel> levels(ModelLevel finest, int count, double length) {
    auto made = levels_of(std::move(finest), count, length, never);
    EXPECT_TRUE(made) << made.error().message;
    return *std::move(made);
}

TEST(Levels, HaveAQuarterOfTheTrianglesAndTheSameLight) {
    for (const double bands : {4.0, 60.0}) {
        const auto all = levels(banded(*sphere_mesh(1, 0.04), bands), 4, 0.06);
        ASSERT_EQ(all.size(), 4u);
        const auto light = [](const ModelLevel& level) {
            return mean_over(level.mesh,
                             [&](std::uint32_t p) { return light_of(level.colours[p][0]); });
        };
        for (std::size_t k = 1; k < all.size(); ++k) {
            EXPECT_NEAR(static_cast<double>(all[k].mesh.triangles.size()),
                        static_cast<double>(all[k - 1].mesh.triangles.size()) / 4, 2);
            EXPECT_EQ(facts_of(all[k].mesh).euler_characteristic, 2);
            EXPECT_NEAR(light(all[k]), light(all[0]), 0.02) << bands << " " << k;
            ASSERT_EQ(all[k].channels.size(), 1u);
            EXPECT_EQ(all[k].channels[0].name, "x");
            EXPECT_NEAR(mean_over(all[k].mesh,
                                  [&](std::uint32_t p) { return all[k].channels[0].values[p]; }),
                        0, 0.02);
        }
        // Wide bands stay black and white. Narrow bands become grey.
        const auto grey = static_cast<double>(
            std::count_if(all[3].colours.begin(), all[3].colours.end(),
                          [](const Colour& c) { return c[0] > 0.2F && c[0] < 0.9F; }));
        const double part = grey / static_cast<double>(all[3].colours.size());
        if (bands < 10) EXPECT_LT(part, 0.3);
        else EXPECT_GT(part, 0.6);
    }
}

TEST(Levels, EndWhereTheTopologyNeedsTheTriangles) {
    const auto all = levels(banded(*torus_mesh(1, 0.4, 0.3), 4), 8, 0.1);
    EXPECT_GE(all.size(), 2u);
    EXPECT_LT(all.size(), 8u);
    EXPECT_EQ(facts_of(all.back().mesh).euler_characteristic, 0);
}

TEST(Levels, KeepNumbersThatAreNotFiniteOutOfMeans) {
    ModelLevel finest = banded(*sphere_mesh(1, 0.1), 4);
    for (std::size_t p = 0; p < finest.mesh.points.size(); ++p) {
        if (p % 2 == 0 || finest.mesh.points[p].x > 0.5) finest.channels[0].values[p] = NAN;
    }
    const auto all = levels(finest, 2, 0.1);
    std::size_t unknown = 0;
    for (std::size_t p = 0; p < all[1].mesh.points.size(); ++p) {
        const float value = all[1].channels[0].values[p];
        if (std::isnan(value)) ++unknown;
        else EXPECT_NEAR(static_cast<double>(value), all[1].mesh.points[p].x, 0.4);
    }
    EXPECT_GT(unknown, 0u);
    EXPECT_LT(unknown, all[1].mesh.points.size() / 2);
}

TEST(Levels, AreAllInOneGlbFileAndInOnesOfTheirOwn) {
    const auto folder = std::filesystem::path(testing::TempDir());
    const auto all = levels(banded(*sphere_mesh(1, 0.1), 4), 3, 0.1);
    const auto paths = write_levels(folder / "ball.glb", all);
    ASSERT_TRUE(paths) << paths.error().message;
    EXPECT_EQ(*paths, (std::vector{folder / "ball.glb", folder / "ball_lod1.glb",
                                   folder / "ball_lod2.glb"}));
    std::ifstream file(folder / "ball.glb", std::ios::binary);
    std::stringstream bytes;
    bytes << file.rdbuf();
    const std::string glb = bytes.str();
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, 4);
    const auto json = nlohmann::json::parse(glb.substr(20, size));
    EXPECT_EQ(json["extensionsUsed"], nlohmann::json::array({"MSFT_lod"}));
    EXPECT_FALSE(json.contains("extensionsRequired"));
    ASSERT_EQ(json["scenes"][0]["nodes"].size(), 1u);
    const auto& node = json["nodes"][json["scenes"][0]["nodes"][0].get<std::size_t>()];
    const auto& ids = node["extensions"]["MSFT_lod"]["ids"];
    EXPECT_EQ(ids.size(), 2u);
    EXPECT_EQ(node["extras"]["MSFT_screencoverage"], nlohmann::json::array({0.25, 0.0625, 0.0}));
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const auto& mesh =
            json["meshes"][json["nodes"][ids[k].get<std::size_t>()]["mesh"].get<std::size_t>()];
        const auto& corners =
            json["accessors"][mesh["primitives"][0]["indices"].get<std::size_t>()];
        EXPECT_EQ(corners["count"], 3 * all[k + 1].mesh.triangles.size());
    }
    // Programs without support for the extension, such as our reader, read the finest level.
    for (std::size_t k = 0; k < 3; ++k) {
        const auto read = read_model((*paths)[k], {});
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->polygon_count(), all[k].mesh.triangles.size());
    }
}

struct Painted {
    SurfaceMesh mesh;
    SurfaceCells cells;
    std::vector<float> values, heights;

    explicit Painted(SurfaceMesh surface) : mesh(std::move(surface)) {
        cells = test::cells_of(mesh, 2000);
        for (const SurfacePlace& place : cells.places) {
            values.push_back(static_cast<float>(wave(position_of(mesh, place))));
        }
    }
    static double wave(Vector3d p) { return 0.5 + 0.4 * std::sin(5 * p.x) * std::cos(4 * p.z); }
    PaintedCells look() const {
        return {1, values,
                [](std::span<const float> at, const SurfacePlace&) -> Colour {
                    return {at[0], at[0], at[0]};
                },
                heights};
    }
};

SurfaceMesh coarse_of(const SurfaceMesh& mesh, std::size_t triangles) {
    return simplify(mesh, triangles, {}, never)->mesh;
}

TEST(LevelMaps, ShowThePatternOfTheFineSurface) {
    Team team(2);
    const Painted fine(*creature().body.mesh(0.05, never));
    const CellFilter filter(fine.mesh, fine.cells, team);
    const PaintedCells look = fine.look();
    SurfaceMesh coarse = coarse_of(fine.mesh, 600);
    coarse.texture = *unwrap(coarse, 256, team, never);
    const FineSurface surface(fine.mesh, filter, look, nullptr);
    BakeOptions options;
    options.width = options.height = 256;
    const auto maps = bake(
        coarse, [&] { return std::make_unique<LevelSamples>(coarse, surface); }, options, team,
        never);
    ASSERT_TRUE(maps) << maps.error().message;
    EXPECT_TRUE(maps->maps.normals);
    EXPECT_FALSE(maps->maps.heights);
    EXPECT_TRUE(maps->relief.pixels.empty());
    EXPECT_EQ(maps->normals.width, 256);
    double sum = 0;
    for (std::uint32_t t = 0; t < coarse.triangles.size(); ++t) {
        TexturePlace at{};
        for (const TexturePlace& corner : coarse.texture[t]) {
            at[0] += corner[0] / 3;
            at[1] += corner[1] / 3;
        }
        const float seen = maps->colour.at(static_cast<std::int64_t>(at[0] * 256),
                                           static_cast<std::int64_t>((1 - at[1]) * 256))[0];
        const Vector3d p = position_of(coarse, {t, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        const SurfacePlace nearest = *NearestPlace(fine.mesh).find(p);
        sum += std::abs(static_cast<double>(seen) - Painted::wave(position_of(fine.mesh, nearest)));
    }
    EXPECT_LT(sum / static_cast<double>(coarse.triangles.size()), 0.02);
}

TEST(LevelMaps, HaveTheNormalsOfTheFineSurface) {
    Team team(1);
    const Painted fine(*sphere_mesh(1, 0.05));
    const CellFilter filter(fine.mesh, fine.cells, team);
    const PaintedCells look = fine.look();
    const SurfaceMesh coarse = coarse_of(fine.mesh, 60);
    const FineSurface surface(fine.mesh, filter, look, nullptr);
    LevelSamples samples(coarse, surface);
    for (std::uint32_t t = 0; t < coarse.triangles.size(); ++t) {
        const SurfacePlace place{t, {0.5, 0.3, 0.2}};
        const Vector3d normal = samples.raised_normal({&place, 1}, {});
        EXPECT_GT(dot(unit(normal), unit(position_of(coarse, place))), std::cos(0.02));
    }
}

TEST(LevelMaps, KnowWhereADisplacedSurfaceWas) {
    // A sphere raised to 1.5 times its size has the colours of the sphere and its own normals.
    Team team(1);
    Painted fine(*sphere_mesh(1, 0.05));
    fine.heights.assign(fine.cells.places.size(), 0.5F);
    const CellFilter filter(fine.mesh, fine.cells, team);
    const PaintedCells look = fine.look();
    RefinedMesh displaced = refined(fine.mesh, 0.04, 1 << 20);
    displace(displaced.mesh, displaced.mesh.points,
             std::vector<float>(displaced.mesh.points.size(), 0.5F));
    const FineSurface surface(fine.mesh, filter, look, &displaced);
    PlacePainter painter = surface.painter();
    for (const Vector3d& p : displaced.mesh.points) {
        EXPECT_NEAR(length(p), 1.5, 2e-3);
        const SurfacePlace place = surface.place_near(p);
        EXPECT_NEAR(length(unit(position_of(fine.mesh, place)) - unit(p)), 0, 1e-3);
        EXPECT_GT(dot(surface.normal_near(p, painter), unit(p)), 0.999);
    }
}

}  // namespace
}  // namespace cascade
