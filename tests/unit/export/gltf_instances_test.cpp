// Reading copies of meshes in glTF files by EXT_mesh_gpu_instancing, also from files that Cascade
// writes.
#include "export/instanced_model.h"
#include "mesh/make_mesh.h"
#include "unit/mesh/built_gltf.h"

#include <cmath>

namespace cascade {
namespace {

using test::BuiltGltf;
using test::expect_points;
using test::Json;
using testing::HasSubstr;

constexpr const char* extension = "EXT_mesh_gpu_instancing";

Json& attributes_of(BuiltGltf& file) { return file.node(0)["extensions"][extension]["attributes"]; }

TEST(GltfInstances, CopiesAreScaledTurnedAndMovedInTheirNode) {
    BuiltGltf file;
    file.json["extensionsRequired"] = {extension};
    attributes_of(file)["TRANSLATION"] = file.add<float>("VEC3", {0, 0, 0, 10, 0, 0});
    attributes_of(file)["SCALE"] = file.add<float>("VEC3", {1, 1, 1, 2, 3, 1});
    // The second copy has a quarter turn about z, in fractions of 32767.
    attributes_of(file)["ROTATION"] =
        file.add<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 23170, 23170}, true);
    file.node(0)["translation"] = {0, 0, 5};
    file.node(0)["scale"] = {2, 2, 2};
    expect_points(file.points(),
                  {{0, 0, 5}, {2, 0, 5}, {0, 4, 5}, {20, 0, 5}, {20, 4, 5}, {8, 0, 5}}, 1e-4);
}

TEST(GltfInstances, AnyOfTheAttributesInOtherNumbersAndBelowOtherNodes) {
    BuiltGltf file;
    attributes_of(file)["ROTATION"] = file.add<std::int8_t>("VEC4", {127, 0, 0, 0}, true);
    file.json["nodes"].push_back({{"children", {0}}, {"translation", {1, 0, 0}}});
    file.json["scenes"][0]["nodes"] = {1};
    expect_points(file.points(), {{1, 0, 0}, {2, 0, 0}, {1, -2, 0}});
    attributes_of(file) = {{"SCALE", file.add<float>("VEC3", {1, 1, 1, 1, 1, -1, 2, 2, 2})}};
    EXPECT_EQ(file.points().size(), 9u);
    // Other attributes give no positions.
    attributes_of(file) = {{"_COLOR_0", file.add<float>("VEC3", {1, 1, 1, 1, 1, 1})}};
    expect_points(file.points(), {{1, 0, 0}, {2, 0, 0}, {1, 2, 0}});
}

TEST(GltfInstances, ColoursOfPointsMaterialsAndCopiesAreMultiplied) {
    BuiltGltf file;
    file.primitive()["material"] = 0;
    file.json["materials"] =
        Json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 0.25, 1}}}}}});
    EXPECT_TRUE(file.read()->attributes.empty());
    attributes_of(file)["TRANSLATION"] = file.add<float>("VEC3", {0, 0, 0, 10, 0, 0});
    attributes_of(file)["_COLOR_0"] = file.add<float>("VEC3", {1, 0.5, 0, 1, 1, 1});
    const auto red = [&] { return file.read()->attributes.at(0).values; };
    EXPECT_THAT(red(), testing::ElementsAre(0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F));
    file.primitive()["attributes"]["COLOR_0"] =
        file.add<std::uint8_t>("VEC4", {255, 0, 0, 255, 0, 0, 0, 255, 51, 0, 0, 255}, true);
    EXPECT_THAT(red(), testing::ElementsAre(0.5F, 0, 0.1F, 0.5F, 0, 0.1F));
    EXPECT_THAT(file.read()->attributes.at(2).values, testing::ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST(GltfInstances, BrokenCopies) {
    const auto fault = [](const auto& change) {
        BuiltGltf file;
        attributes_of(file)["TRANSLATION"] = file.add<float>("VEC3", {0, 0, 0, 10, 0, 0});
        change(file);
        return file.fault();
    };
    const auto wrong = HasSubstr("(EXT_mesh_gpu_instancing) in the glTF file lie beyond its data");
    EXPECT_THAT(fault([](BuiltGltf& file) {
                    attributes_of(file)["SCALE"] = file.add<float>("VEC3", {1, 1, 1});
                }),
                wrong);
    EXPECT_THAT(fault([](BuiltGltf& file) { attributes_of(file)["TRANSLATION"] = 99; }), wrong);
    EXPECT_THAT(fault([](BuiltGltf& file) { attributes_of(file)["TRANSLATION"] = "all"; }), wrong);
    EXPECT_THAT(fault([](BuiltGltf& file) { file.accessor(1)["count"] = 3; }), wrong);
    EXPECT_THAT(fault([](BuiltGltf& file) { file.accessor(1).erase("bufferView"); }), wrong);
    EXPECT_THAT(fault([](BuiltGltf& file) {
                    file.node(0)["skin"] = 0;
                    file.json["skins"] = Json::array({{{"joints", {0}}}});
                }),
                HasSubstr("copies of a skinned mesh"));
}

TEST(GltfInstances, CopiesWithoutPointsAreBounded) {
    BuiltGltf file;
    file.accessor(0)["count"] = 0;
    const std::size_t places = file.add<float>("VEC3", std::vector<double>(30000));
    Json nodes = Json::array(), roots = Json::array();
    for (int k = 0; k < 8000; ++k) {
        nodes.push_back({{"mesh", 0}});
        nodes.back()["extensions"][extension]["attributes"]["TRANSLATION"] = places;
        roots.push_back(k);
    }
    file.json["nodes"] = nodes;
    file.json["scenes"][0]["nodes"] = roots;
    EXPECT_EQ(file.fault(),
              "the glTF file reads its data more often than a file of this size "
              "should");
}

TEST(GltfInstances, WhatIsWrittenComesBackAsItWentOut) {
    TriangleMesh spike;
    spike.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    spike.normals.assign(4, {0, 0, 1});
    spike.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    Instances copies;
    copies.meshes = {spike};
    for (int k = 0; k < 40; ++k) {
        Placement placement;
        placement.place = {1e6 + 5.0 * k, -3.0 * k, 0.25 * k};
        placement.turn = of_length_1({1, 0.3 * k, -0.2, 0.1 * k});
        placement.scale = {1 + 0.1 * k, 1, 2};
        placement.colour = {static_cast<float>(k) / 40, 0.5F, 1};
        copies.placements.push_back(placement);
    }
    const InstancedModel model{nullptr, {}, copies};
    const auto instanced = encode_instanced_glb(model), merged = encode_merged_glb(model);
    ASSERT_TRUE(instanced && merged);
    const auto some = read_gltf(*instanced), all = read_gltf(*merged);
    ASSERT_TRUE(some) << some.error().message;
    ASSERT_TRUE(all);
    EXPECT_EQ(some->polygon_count(), all->polygon_count());
    const auto one = make_mesh(*some), other = make_mesh(*all);
    ASSERT_TRUE(one && other);
    const MeshFacts seen = facts_of(one->mesh), wanted = facts_of(other->mesh);
    EXPECT_EQ(seen.triangles, 160u);
    EXPECT_EQ(seen.triangles, wanted.triangles);
    EXPECT_NEAR(seen.area, wanted.area, 1e-3 * wanted.area);
    // Both files have the same colours, in different orders.
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> lights = some->attributes.at(c).values,
                           others = all->attributes.at(c).values;
        std::sort(lights.begin(), lights.end());
        std::sort(others.begin(), others.end());
        for (std::size_t k = 0; k < lights.size(); ++k) EXPECT_NEAR(lights[k], others[k], 1e-4);
    }
    EXPECT_LE(length(seen.low - wanted.low) + length(seen.high - wanted.high), 2e-3);
}

}  // namespace
}  // namespace cascade
