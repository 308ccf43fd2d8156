// Written model files, read again by our own readers.
#include "export/glb.h"
#include "export/model_writer.h"
#include "mesh/model_file.h"
#include "mesh/normals.h"
#include "picture/srgb.h"
#include "unit/export/example_surfaces.h"

#include <cstring>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <limits>
#include <nlohmann/json.hpp>

namespace cascade {
namespace {

using test::flat_square;
using test::place_colours;
using test::sphere_with_texture;
using test::x_channel;
using ::testing::HasSubstr;

SurfaceMesh read_back(const Result<PolygonSoup>& soup) {
    EXPECT_TRUE(soup.has_value()) << soup.error().message;
    return test::mesh_of(*soup);
}

void expect_same(const SurfaceMesh& read, const SurfaceMesh& mesh, double tolerance) {
    ASSERT_EQ(read.points.size(), mesh.points.size());
    EXPECT_EQ(read.triangles, mesh.triangles);
    EXPECT_EQ(read.across, mesh.across);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        EXPECT_LE(length(read.points[p] - mesh.points[p]), tolerance) << p;
    }
}

void expect_same_texture(const SurfaceMesh& read, const SurfaceMesh& mesh, float tolerance) {
    ASSERT_EQ(read.texture.size(), mesh.texture.size());
    for (std::size_t t = 0; t < mesh.texture.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(read.texture[t][k][0], mesh.texture[t][k][0], tolerance);
            EXPECT_NEAR(read.texture[t][k][1], mesh.texture[t][k][1], tolerance);
        }
    }
}

const PointAttribute& attribute(const SurfaceMesh& mesh, const std::string& name) {
    for (const PointAttribute& candidate : mesh.attributes) {
        if (candidate.name == name) return candidate;
    }
    ADD_FAILURE() << "no attribute " << name;
    static const PointAttribute none;
    return none;
}

TEST(ModelWriter, PlyIsReadBackExactly) {
    const SurfaceMesh mesh = sphere_with_texture(12);
    const std::vector<Colour> colours = place_colours(mesh);
    const Channel channels[] = {x_channel(mesh),
                                {"a b", x_channel(mesh).values},
                                {"u", x_channel(mesh).values}};
    const SurfaceMesh read = read_back(read_ply(encode_ply(mesh, {colours, channels})));
    expect_same(read, mesh, 0);
    expect_same_texture(read, mesh, 0);
    EXPECT_EQ(attribute(read, "u_").values, channels[0].values);
    EXPECT_EQ(attribute(read, "a_b").values, channels[0].values);
    EXPECT_EQ(attribute(read, "u__").values, channels[0].values);
    const std::vector<Vector3d> normals = point_normals(mesh);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        EXPECT_NEAR(attribute(read, "red").values[p], 255 * colours[p][0], 0.501F);
        EXPECT_NEAR(attribute(read, "blue").values[p], 255 * colours[p][2], 0.501F);
        EXPECT_EQ(attribute(read, "nx").values[p], static_cast<float>(normals[p].x));
    }
}

TEST(ModelWriter, PlyOfSinglePlacesIsSmaller) {
    const SurfaceMesh exact = flat_square(4), inexact = flat_square(3);
    EXPECT_THAT(encode_ply(exact, {}), HasSubstr("property float x\n"));
    EXPECT_THAT(encode_ply(inexact, {}), HasSubstr("property double x\n"));
}

TEST(ModelWriter, ObjIsReadBackExactly) {
    const SurfaceMesh mesh = sphere_with_texture(10);
    const std::vector<Colour> colours = place_colours(mesh);
    const std::string text = encode_obj(mesh, {colours, {}});
    const SurfaceMesh read = read_back(read_obj(text));
    expect_same(read, mesh, 1e-7);
    expect_same_texture(read, mesh, 1e-7F);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        EXPECT_NEAR(attribute(read, "green").values[p], colours[p][1], 0.003F);
    }
    EXPECT_THAT(encode_obj(flat_square(1), {}), HasSubstr("v 1 0 0\n"));
    // Texture coordinates that several corners share are written once.
    std::set<TexturePlace> places;
    for (const auto& corners : mesh.texture) places.insert(corners.begin(), corners.end());
    std::size_t written = 0;
    for (std::size_t at = 0; (at = text.find("\nvt ", at)) != std::string::npos; ++at) ++written;
    EXPECT_EQ(written, places.size());
    EXPECT_THAT(text, HasSubstr("\ns 1\nf "));
}

TEST(ModelWriter, GlbIsReadBack) {
    const SurfaceMesh mesh = sphere_with_texture(11);
    const std::vector<Colour> colours = place_colours(mesh);
    GlbLook look;
    look.colours = colours;
    const Result<std::string> bytes = encode_glb(mesh, look);
    ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
    const SurfaceMesh read = read_back(read_gltf(*bytes));
    expect_same(read, mesh, 2e-7);
    expect_same_texture(read, mesh, 1e-7F);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        EXPECT_NEAR(attribute(read, "red").values[p], light_of(colours[p][0]), 1e-5F);
    }
}

/// The JSON chunk of a GLB file.
nlohmann::json json_of(const std::string& glb) {
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, 4);
    return nlohmann::json::parse(glb.substr(20, size));
}

TEST(ModelWriter, GlbKeepsPlacesFarFromTheOriginApart) {
    SurfaceMesh mesh = flat_square(8);
    const Vector3d far = {1e8 + 1.0 / 3, 2e8, -3e8};
    for (Vector3d& p : mesh.points) p = p + far;
    const Result<std::string> bytes = encode_glb(mesh, {});
    ASSERT_TRUE(bytes.has_value());
    EXPECT_TRUE(json_of(*bytes)["nodes"][0].contains("translation"));
    expect_same(read_back(read_gltf(*bytes)), mesh, 1e-6);
    EXPECT_FALSE(json_of(*encode_glb(flat_square(8), {}))["nodes"][0].contains("translation"));
}

TEST(ModelWriter, GlbOfABoundaryIsSeenFromBothSides) {
    EXPECT_TRUE(json_of(*encode_glb(flat_square(2), {}))["materials"][0].contains("doubleSided"));
    EXPECT_FALSE(
        json_of(*encode_glb(sphere_with_texture(6), {}))["materials"][0].contains("doubleSided"));
}

TEST(ModelWriter, GlbRefusesWhatBinary32DoesNotHold) {
    for (const double scale : {1e-40, 1e40}) {
        SurfaceMesh mesh = flat_square(2);
        for (Vector3d& p : mesh.points) p = p * scale;
        const Result<std::string> bytes = encode_glb(mesh, {});
        ASSERT_FALSE(bytes.has_value());
        EXPECT_THAT(bytes.error().message, HasSubstr("does not fit into a GLB file"));
        expect_same(read_back(read_ply(encode_ply(mesh, {}))), mesh, 0);
    }
}

TEST(ModelWriter, StlFilesOfModelsFarAwayAreMoved) {
    const SurfaceMesh ball = sphere_with_texture(12);
    const auto moved = [&](Vector3d by, double scale) {
        SurfaceMesh mesh = ball;
        for (Vector3d& p : mesh.points) p = p * scale + by;
        return mesh;
    };
    // Close to the origin: not moved.
    for (const Vector3d by : {Vector3d{}, {3, 0, 0}, {40.1, -20, 7}}) {
        EXPECT_EQ(stl_origin(moved(by, 1)), Vector3d{});
    }
    EXPECT_EQ(stl_origin(moved({4096, 0, 0}, 1e-9)).y, 0);
    for (const Vector3d by : {Vector3d{403000, 3604900, 1000}, {0, 0, -1e9}, {1e5, 0, 0}}) {
        for (const double scale : {0.05, 0.75}) {
            const SurfaceMesh mesh = moved(by, scale);
            const Vector3d origin = stl_origin(mesh);
            EXPECT_LE(length(origin - by), 1e-6 * length(by));
            const SurfaceMesh read = read_back(read_stl(encode_stl(mesh, origin)));
            EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
            EXPECT_EQ(facts_of(read).boundary_edges, 0U);
            EXPECT_NEAR(read.total_area(), mesh.total_area(), 1e-5 * mesh.total_area());
        }
    }
    // A model with exact coordinates is not moved.
    SurfaceMesh square = flat_square(2);
    for (Vector3d& p : square.points) p = p + Vector3d{1 << 20, 0, 0};
    EXPECT_EQ(stl_origin(square), Vector3d{});
    EXPECT_TRUE(remarks_of_origin("a.stl", {}).empty());
    EXPECT_THAT(remarks_of_origin("x/a.stl", {1, -2, 0.5}).at(0),
                HasSubstr("in 'a.stl' the model is moved by -1, 2, -0.5, to the origin"));
    EXPECT_EQ(origin_of_file("a.ply", moved({1e6, 0, 0}, 0.05)), Vector3d{});
}

TEST(ModelWriter, WhatIsNoNumberHasAMeaning) {
    const SurfaceMesh mesh = flat_square(1);
    const float nan = -std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const std::vector<Colour> colours = {
        {nan, 0, 0}, {infinite, -infinite, 2}, {0, 0, 0}, {1, 1, 1}};
    const Channel channels[] = {{"c", {nan, infinite, 0, 1}}};
    const SurfaceMesh read = read_back(read_ply(encode_ply(mesh, {colours, channels})));
    std::uint32_t bits = 0;
    std::memcpy(&bits, &attribute(read, "c").values[0], 4);
    EXPECT_EQ(bits, 0x7fc00000u);
    EXPECT_EQ(attribute(read, "c").values[1], infinite);
    EXPECT_THAT(attribute(read, "red").values, ::testing::ElementsAre(255, 255, 0, 255));
    EXPECT_THAT(attribute(read, "green").values, ::testing::ElementsAre(0, 0, 0, 255));
    EXPECT_THAT(attribute(read, "blue").values, ::testing::ElementsAre(255, 255, 0, 255));
    EXPECT_THAT(encode_obj(mesh, {colours, {}}), HasSubstr("v 0 0 0 1 0 1\nv 1 0 0 1 0 1\n"));
    GlbLook look;
    look.colours = colours;
    EXPECT_TRUE(read_gltf(*encode_glb(mesh, look)).has_value());
}

TEST(ModelWriter, TextureCoordinatesThatAreNoNumbersBecomeZero) {
    SurfaceMesh mesh = flat_square(1);
    mesh.texture[0][1] = {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity()};
    const Result<PolygonSoup> read = read_gltf(*encode_glb(mesh, {}));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->texture[1], (TexturePlace{0, 0}));
}

TEST(ModelWriter, WritesByTheEnding) {
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / "cascade_model_writer";
    std::filesystem::create_directories(folder);
    const SurfaceMesh mesh = sphere_with_texture(4);
    for (const char* name : {"a.ply", "a.OBJ", "a.glb"}) {
        ASSERT_TRUE(write_model(folder / name, mesh, {}).has_value());
        expect_same(read_back(read_model(folder / name)), mesh, 2e-7);
    }
    // In an STL file triangles share no points, and there is no texture.
    ASSERT_TRUE(write_model(folder / "a.stl", mesh, {}).has_value());
    const SurfaceMesh printed = read_back(read_model(folder / "a.stl"));
    EXPECT_EQ(printed.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(facts_of(printed).boundary_edges, 0U);
    EXPECT_NEAR(printed.total_area(), mesh.total_area(), 1e-6 * mesh.total_area());
    const Result<void> refused = write_model(folder / "a.xyz", mesh, {});
    ASSERT_FALSE(refused.has_value());
    EXPECT_THAT(refused.error().message,
                HasSubstr("a model's name ends in .ply, .obj, .glb, .vtp or .stl"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.xyz"));
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace cascade
