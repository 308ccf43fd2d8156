// Sparse accessors, texture transforms, other sets of coordinates, compression, required extensions
// and hidden nodes in glTF files.
#include "unit/mesh/built_gltf.h"

#include <numbers>

namespace cascade {
namespace {

using test::BuiltGltf;
using test::expect_points;
using test::Json;
using testing::HasSubstr;

/// Replaces elements of an accessor.
template <typename Index, typename Number>
void make_sparse(BuiltGltf& file, std::size_t accessor, const std::vector<double>& places,
                 const std::vector<double>& values) {
    Json sparse = {{"count", places.size()}};
    sparse["indices"] = {{"bufferView", file.add_view<Index>(places)},
                         {"componentType", BuiltGltf::code_of<Index>()}};
    sparse["values"] = {{"bufferView", file.add_view<Number>(values)}};
    file.accessor(accessor)["sparse"] = sparse;
}

TEST(GltfSparse, WithAndWithoutABase) {
    BuiltGltf file;
    make_sparse<std::uint8_t, float>(file, 0, {2}, {0, 3, 1});
    expect_points(file.points(), {{0, 0, 0}, {1, 0, 0}, {0, 3, 1}});
    file.accessor(0).erase("bufferView");
    make_sparse<std::uint16_t, float>(file, 0, {0, 2}, {1, 0, 0, 0, 3, 1});
    expect_points(file.points(), {{1, 0, 0}, {0, 0, 0}, {0, 3, 1}});
    make_sparse<std::uint32_t, float>(file, 0, {0, 1, 2}, {1, 0, 0, 2, 0, 0, 0, 3, 1});
    expect_points(file.points(), {{1, 0, 0}, {2, 0, 0}, {0, 3, 1}});
}

TEST(GltfSparse, OfIntegersCornersAndTargets) {
    BuiltGltf file;
    const std::size_t corners = file.add<std::uint8_t>("SCALAR", {0, 1, 1});
    file.primitive()["indices"] = corners;
    make_sparse<std::uint8_t, std::uint8_t>(file, corners, {2}, {2});
    const std::size_t shift = file.add<std::int16_t>("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 0}, true);
    file.accessor(shift).erase("bufferView");
    make_sparse<std::uint8_t, std::int16_t>(file, shift, {1}, {0, 0, -32768});
    file.primitive()["targets"] = Json::array({{{"POSITION", shift}}});
    file.json["meshes"][0]["weights"] = {2};
    const auto soup = file.read();
    ASSERT_TRUE(soup.has_value()) << soup.error().message;
    EXPECT_THAT(soup->polygon(0), testing::ElementsAre(0, 1, 2));
    expect_points(soup->points, {{0, 0, 0}, {1, 0, -2}, {0, 2, 0}});
    file.accessor(corners).erase("bufferView");
    EXPECT_THAT(file.fault(), HasSubstr("sparse values without a base"));
}

TEST(GltfNodes, MirroredTrianglesAreTurned) {
    const auto polygon_of = [](const Json& node) {
        BuiltGltf file;
        file.json["nodes"] = Json::array({node});
        const auto soup = file.read();
        EXPECT_TRUE(soup.has_value()) << soup.error().message;
        return soup ? std::vector<std::uint32_t>(soup->polygon(0).begin(), soup->polygon(0).end())
                    : std::vector<std::uint32_t>();
    };
    const auto turned = testing::ElementsAre(0, 2, 1), plain = testing::ElementsAre(0, 1, 2);
    EXPECT_THAT(polygon_of({{"mesh", 0}, {"scale", {-1, 1, 1}}}), turned);
    EXPECT_THAT(polygon_of({{"mesh", 0}, {"scale", {-1, -2, -3}}}), turned);
    EXPECT_THAT(polygon_of({{"mesh", 0}, {"scale", {-1, -1, 1}}}), plain);
    EXPECT_THAT(polygon_of({{"mesh", 0}, {"rotation", {0, 1, 0, 0}}}), plain);
}

TEST(GltfVisibility, HiddenNodesAreLeftOutWithThoseBelow) {
    BuiltGltf file;
    file.json["extensionsRequired"] = {"KHR_node_visibility"};
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.json["nodes"].push_back({{"children", {2}}});
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 7}}});
    Json& visible = file.node(1)["extensions"]["KHR_node_visibility"]["visible"];
    visible = true;
    EXPECT_EQ(file.points().size(), 6u);
    visible = false;
    expect_points(file.points(), {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}});
    file.node(1)["extensions"]["KHR_node_visibility"] = Json::object();  // Visible by default.
    EXPECT_EQ(file.points().size(), 6u);
    file.node(2)["extensions"]["KHR_node_visibility"]["visible"] = false;
    EXPECT_EQ(file.points().size(), 3u);
    file.node(0)["extensions"]["KHR_node_visibility"]["visible"] = false;
    EXPECT_THAT(file.fault(), HasSubstr("no triangles"));
}

TEST(GltfSparse, BrokenOnes) {
    const auto fault = [](const std::vector<double>& places, const auto& change) {
        BuiltGltf file;
        make_sparse<std::uint8_t, float>(file, 0, places, {0, 3, 1, 1, 1, 1});
        change(file.accessor(0)["sparse"]);
        return file.fault();
    };
    const auto nothing = [](Json&) {};
    const char* const wrong = "the glTF file has triangles without positions or beyond its data";
    EXPECT_EQ(fault({0, 1}, nothing), "read");
    EXPECT_EQ(fault({1, 1}, nothing), wrong);
    EXPECT_EQ(fault({2, 1}, nothing), wrong);
    EXPECT_EQ(fault({1, 3}, nothing), wrong);
    EXPECT_EQ(fault({0, 1, 2}, nothing), wrong);
    EXPECT_EQ(fault({0}, [](Json& sparse) { sparse["count"] = -1; }), wrong);
    EXPECT_EQ(fault({0}, [](Json& sparse) { sparse["count"] = 2000000000; }), wrong);
    EXPECT_EQ(fault({0}, [](Json& sparse) { sparse["values"]["byteOffset"] = -4; }), wrong);
    EXPECT_EQ(fault({0}, [](Json& sparse) { sparse["values"]["bufferView"] = 77; }), wrong);
    EXPECT_EQ(fault({0}, [](Json& sparse) { sparse["indices"]["componentType"] = 5126; }), wrong);
}

/// The texture coordinates of the triangle's corners, with the origin at the upper left.
std::vector<std::array<double, 2>> texture_of(BuiltGltf& file) {
    const auto soup = file.read();
    EXPECT_TRUE(soup.has_value()) << soup.error().message;
    std::vector<std::array<double, 2>> places;
    for (const TexturePlace& place : soup->texture) places.push_back({place[0], 1 - place[1]});
    return places;
}

void expect_texture(BuiltGltf& file, const std::vector<std::array<double, 2>>& wanted) {
    const auto seen = texture_of(file);
    ASSERT_EQ(seen.size(), wanted.size());
    for (std::size_t k = 0; k < seen.size(); ++k) {
        EXPECT_NEAR(seen[k][0], wanted[k][0], 1e-6) << k;
        EXPECT_NEAR(seen[k][1], wanted[k][1], 1e-6) << k;
    }
}

/// Gives the triangle a material, and returns its texture of base colours.
Json& textured(BuiltGltf& file) {
    file.primitive()["attributes"]["TEXCOORD_0"] = file.add<float>("VEC2", {0, 0, 1, 0, 0, 1});
    file.primitive()["attributes"]["TEXCOORD_1"] =
        file.add<std::uint16_t>("VEC2", {0, 0, 65535, 65535, 0, 13107}, true);
    file.primitive()["material"] = 0;
    file.json["materials"] = Json::array({Json::object()});
    Json& texture = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["index"] = 0;
    return texture;
}

TEST(GltfTexture, ScaleRotationAndOffset) {
    BuiltGltf file;
    Json& texture = textured(file);
    expect_texture(file, {{0, 0}, {1, 0}, {0, 1}});
    file.json["extensionsRequired"] = {"KHR_texture_transform"};
    Json& transform = texture["extensions"]["KHR_texture_transform"];
    transform["scale"] = {0.5, 0.25};
    expect_texture(file, {{0, 0}, {0.5, 0}, {0, 0.25}});
    transform["offset"] = {0.125, 0.5};
    expect_texture(file, {{0.125, 0.5}, {0.625, 0.5}, {0.125, 0.75}});
    // The extension's own example: the lower left quarter of the picture.
    transform = {{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    expect_texture(file, {{0, 1}, {0, 0.5}, {0.5, 1}});
    transform["texCoord"] = 1;
    expect_texture(file, {{0, 1}, {0.5, 0.5}, {0.1, 1}});
}

TEST(GltfTexture, TheSetThatTheMaterialNames) {
    BuiltGltf file;
    Json& texture = textured(file);
    texture["texCoord"] = 1;
    expect_texture(file, {{0, 0}, {1, 1}, {0, 0.2}});
    // This set does not exist, so the first set is used, without the transform.
    texture["texCoord"] = 5;
    texture["extensions"]["KHR_texture_transform"]["offset"] = {7, 7};
    expect_texture(file, {{0, 0}, {1, 0}, {0, 1}});
    // Without a texture of colours, the coordinates for the texture of normals are used.
    file.json["materials"][0] = {{"normalTexture", {{"index", 0}, {"texCoord", 1}}}};
    expect_texture(file, {{0, 0}, {1, 1}, {0, 0.2}});
    // In older files the texture of colours is in an extension.
    file.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseTexture",
         {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 3}}}}}}}}};
    expect_texture(file, {{0, 0}, {2, 0}, {0, 3}});
    file.primitive()["material"] = 9;
    expect_texture(file, {{0, 0}, {1, 0}, {0, 1}});
}

TEST(GltfRequirements, OtherVersionsAreNamed) {
    BuiltGltf file;
    file.json["asset"]["version"] = "1.0";
    EXPECT_EQ(file.fault(), "this is a glTF file of version 1, but only version 2 can be read");
    const auto fault = [](const std::string& text) { return read_gltf(text).error().message; };
    EXPECT_THAT(fault(R"({"asset":{"generator":"x"},"meshes":{"m":{"primitives":[]}}})"),
                HasSubstr("version 1"));
    EXPECT_THAT(fault(std::string("glTF\1\0\0\0\0\0\0\0", 12)),
                HasSubstr("a GLB file of version 1"));
    file.json["asset"]["version"] = "2.1";
    EXPECT_EQ(file.fault(), "read");
    file.json["asset"]["minVersion"] = "2.0";
    EXPECT_EQ(file.fault(), "read");
    file.json["asset"]["minVersion"] = "2.1";
    EXPECT_EQ(file.fault(), "the glTF file requires version 2.1, but only version 2.0 can be read");
}

TEST(GltfRequirements, UnknownExtensionsAreNamedIfTheyAreRequired) {
    BuiltGltf file;
    file.json["extensionsUsed"] = {"CESIUM_RTC"};
    EXPECT_EQ(file.fault(), "read");
    for (const char* known : {"KHR_materials_unlit", "KHR_materials_anything", "KHR_texture_basisu",
                              "KHR_lights_punctual", "KHR_mesh_quantization", "EXT_texture_webp"}) {
        file.json["extensionsRequired"] = {known};
        EXPECT_EQ(file.fault(), "read") << known;
    }
    file.json["extensionsRequired"] = {"KHR_materials_unlit", "CESIUM_RTC"};
    EXPECT_EQ(file.fault(),
              "the glTF file requires the extension 'CESIUM_RTC', which Cascade "
              "cannot read");
    file.json["extensionsRequired"] = {17};
    EXPECT_EQ(file.fault(), "read");
}

TEST(GltfRequirements, CompressedDataAreNamedUnlessThereArePlainOnes) {
    BuiltGltf file;
    file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    file.primitive()["indices"] = file.add<std::uint32_t>("SCALAR", {0, 1, 2});
    Json& draco = file.primitive()["extensions"]["KHR_draco_mesh_compression"];
    draco = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    EXPECT_EQ(file.fault(), "read");
    file.accessor(1).erase("bufferView");
    EXPECT_THAT(file.fault(), HasSubstr("compressed by Draco (KHR_draco_mesh_compression)"));
    file.accessor(0).erase("bufferView");
    file.primitive().erase("indices");
    EXPECT_THAT(file.fault(), HasSubstr("compressed by Draco (KHR_draco_mesh_compression)"));

    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        BuiltGltf packed;
        packed.json["extensionsRequired"] = {name};
        packed.json["bufferViews"][0]["extensions"][name] = {{"buffer", 0}, {"byteLength", 9}};
        EXPECT_EQ(packed.fault(), "read") << name;
        std::string text = test::gltf_text();
        const auto put = [&](const std::string& before, const std::string& added) {
            text.insert(text.find(before) + before.size(), added);
        };
        put(R"("bufferViews":[{"buffer":0)",
            R"(,"extensions":{")" + std::string(name) + R"(":{"buffer":0,"byteLength":9}})");
        EXPECT_TRUE(read_gltf(text).has_value());  // The buffer has the plain data.
        text.replace(text.find(R"([{"buffer":0,"ext)"), 12, R"([{"buffer":1)");
        const std::string fallback =
            R"(},{"byteLength":36,"extensions":{")" + std::string(name) + R"(":{"fallback":true}})";
        text.insert(text.find(R"(}],"bufferViews")"), fallback);
        const auto soup = read_gltf(text);
        ASSERT_FALSE(soup.has_value());
        EXPECT_EQ(soup.error().message, "the glTF file is compressed by Meshopt (" +
                                            std::string(name) + "), which Cascade cannot read");
    }
}

}  // namespace
}  // namespace cascade
