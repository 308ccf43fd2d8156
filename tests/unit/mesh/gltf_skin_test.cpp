// Skins and default weights of morph targets of glTF files, compared with transformations by hand.
#include "unit/mesh/built_gltf.h"

#include <cmath>
#include <numbers>

namespace cascade {
namespace {

using test::BuiltGltf;
using test::expect_points;
using test::Json;
using testing::HasSubstr;

const double half = std::sqrt(0.5);
const Json up = {-half, 0, 0, half};  ///< Turns y to −z, and z to y.

/// A triangle whose points follow the only joint of a skin.
template <typename Index = std::uint8_t>
BuiltGltf skinned() {
    BuiltGltf file;
    file.primitive()["attributes"]["JOINTS_0"] =
        file.add<Index>("VEC4", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    file.primitive()["attributes"]["WEIGHTS_0"] =
        file.add<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    file.node(0)["skin"] = 0;
    file.json["skins"] = Json::array({{{"joints", {2}}}});
    file.json["nodes"].push_back({{"children", {2}}});
    file.json["nodes"].push_back(Json::object());
    file.json["scenes"][0]["nodes"] = {0, 1};
    return file;
}

TEST(GltfSkin, JointsPlaceTheMeshAndItsOwnNodesDoNot) {
    BuiltGltf file = skinned();
    file.node(1)["rotation"] = up;
    file.node(2)["translation"] = {0, 0, 5};
    file.node(0)["translation"] = {100, 0, 0};
    file.node(0)["scale"] = {7, 7, 7};
    // (x, y, z) becomes (x, z + 5, −y).
    expect_points(file.points(), {{0, 5, 0}, {1, 5, 0}, {0, 5, -2}});
}

TEST(GltfSkin, JointsOutsideOfTheSceneAndByMatricesAndOfWideNumbers) {
    BuiltGltf file = skinned<std::uint16_t>();
    file.json["scenes"][0]["nodes"] = {0};
    file.node(1)["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 1, 1, 1};
    // The joint was at (1, 1, 1) in the bind pose, and has moved to (3, 3, 3).
    file.node(2)["translation"] = {1, 1, 1};
    file.json["skins"][0]["inverseBindMatrices"] =
        file.add<float>("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, -1, -1, 1});
    expect_points(file.points(), {{1, 1, 1}, {3, 1, 1}, {1, 5, 1}});
}

TEST(GltfSkin, WeightsAreSharedAndNeedNotHaveTheSumOne) {
    BuiltGltf file = skinned();
    file.json["nodes"].push_back({{"translation", {0, 0, 8}}});
    file.json["skins"][0]["joints"] = {2, 3};
    Json& attributes = file.primitive()["attributes"];
    attributes["JOINTS_0"] = file.add<std::uint8_t>("VEC4", {1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0});
    // Weights are stored as fractions of 255 and of 65535. The last point also uses the second set.
    attributes["WEIGHTS_0"] =
        file.add<std::uint8_t>("VEC4", {255, 0, 0, 0, 51, 204, 0, 0, 51, 0, 0, 0}, true);
    attributes["JOINTS_1"] = file.add<std::uint16_t>("VEC4", {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0});
    attributes["WEIGHTS_1"] =
        file.add<std::uint16_t>("VEC4", {0, 0, 0, 0, 0, 0, 0, 0, 13107, 0, 0, 0}, true);
    expect_points(file.points(), {{0, 0, 8}, {1, 0, 6.4}, {0, 2, 4}});
}

TEST(GltfSkin, TwoNodesAndTwoScenesShareASkin) {
    BuiltGltf file = skinned();
    file.node(2)["translation"] = {0, 0, 5};
    file.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 1}}});
    file.json["scenes"].push_back({{"nodes", {1, 3, 4}}});
    file.json["scene"] = 1;
    // The order is that of the scene. Node 4 has no skin.
    expect_points(file.points(),
                  {{0, 0, 5}, {1, 0, 5}, {0, 2, 5}, {0, 0, 1}, {1, 0, 1}, {0, 2, 1}});
}

TEST(GltfSkin, BrokenSkins) {
    const auto fault = [](const auto& change) {
        BuiltGltf file = skinned();
        change(file);
        return file.fault();
    };
    EXPECT_EQ(fault([](BuiltGltf& file) { file.node(0)["skin"] = 3; }),
              "the glTF file has no skin 3");
    EXPECT_EQ(fault([](BuiltGltf& file) { file.json["skins"][0]["joints"] = {9}; }),
              "the glTF file has no node 9");
    EXPECT_EQ(fault([](BuiltGltf& file) { file.json["skins"][0]["joints"] = Json::array(); }),
              "a point of the glTF file follows joint 0, but its skin has only 0");
    EXPECT_EQ(fault([](BuiltGltf& file) { file.node(2)["children"] = {1}; }),
              "the nodes of the glTF file do not form a tree");
    EXPECT_THAT(
        fault([](BuiltGltf& file) {
            file.json["skins"][0]["inverseBindMatrices"] = file.add<float>("VEC4", {1, 2, 3, 4});
        }),
        HasSubstr("fewer matrices than joints"));
    EXPECT_THAT(fault([](BuiltGltf& file) { file.primitive()["attributes"].erase("WEIGHTS_0"); }),
                HasSubstr("lack joints or weights"));
    EXPECT_THAT(fault([](BuiltGltf& file) {
                    file.primitive()["attributes"]["JOINTS_0"] =
                        file.add<std::uint8_t>("VEC4", {0, 0, 0, 0});
                }),
                HasSubstr("lack joints or weights"));
}

TEST(GltfMorph, DefaultWeightsOfTheMeshAndOfTheNode) {
    BuiltGltf file;
    const std::size_t moved = file.add<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 3});
    const std::size_t wider = file.add<std::int8_t>("VEC3", {0, 0, 0, 127, 0, 0, -127, 0, 0}, true);
    file.primitive()["targets"] = Json::array({{{"POSITION", moved}}, {{"POSITION", wider}}});
    expect_points(file.points(), {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}});
    file.json["meshes"][0]["weights"] = {1, 0.5};
    expect_points(file.points(), {{0, 0, 1}, {1.5, 0, 1}, {-0.5, 2, 3}});
    file.node(0)["weights"] = {0, 1};
    expect_points(file.points(), {{0, 0, 0}, {2, 0, 0}, {-1, 2, 0}});
    file.node(0)["weights"] = {-1, 0};
    expect_points(file.points(), {{0, 0, -1}, {1, 0, -1}, {0, 2, -3}});
    // Morph targets apply before the node's transform and before joints.
    file.node(0)["scale"] = {2, 2, 2};
    expect_points(file.points(), {{0, 0, -2}, {2, 0, -2}, {0, 4, -6}});
    file.json["accessors"][moved]["count"] = 2;
    EXPECT_THAT(file.fault(), HasSubstr("a morph target of the glTF file has too few points"));
}

TEST(GltfMorph, TargetsOfColoursAndTexturePlaces) {
    BuiltGltf file;
    Json& attributes = file.primitive()["attributes"];
    attributes["COLOR_0"] = file.add<float>("VEC3", {1, 1, 1, 1, 1, 1, 0, 0, 0});
    attributes["TEXCOORD_0"] = file.add<float>("VEC2", {0, 0, 1, 0, 0, 1});
    Json target;
    target["COLOR_0"] = file.add<float>("VEC3", {-1, 0, 0, 0, -1, 0, 0, 0, 0.5});
    target["TEXCOORD_0"] = file.add<float>("VEC2", {0.25, 0, 0, 0, 0, 0});
    file.primitive()["targets"] = Json::array({target});
    file.json["meshes"][0]["weights"] = {0.5};
    const auto soup = file.read();
    ASSERT_TRUE(soup.has_value()) << soup.error().message;
    EXPECT_THAT(soup->attributes[0].values, testing::ElementsAre(0.5F, 1, 0));
    EXPECT_THAT(soup->attributes[1].values, testing::ElementsAre(1, 0.5F, 0));
    EXPECT_THAT(soup->attributes[2].values, testing::ElementsAre(1, 1, 0.25F));
    EXPECT_EQ(soup->texture[0], (TexturePlace{0.125F, 1}));
}

TEST(GltfMorph, TheSameTargetAgainAndAgainIsBounded) {
    BuiltGltf file;
    const std::size_t shift = file.add<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 3});
    Json targets = Json::array(), weights = Json::array();
    for (int k = 0; k < 5000; ++k) {
        targets.push_back({{"POSITION", shift}});
        weights.push_back(1e-9);
    }
    file.primitive()["targets"] = targets;
    file.json["meshes"][0]["weights"] = weights;
    EXPECT_EQ(file.fault(), "read");
    Json nodes = Json::array(), roots = Json::array();
    for (int k = 0; k < 4000; ++k) {
        nodes.push_back({{"mesh", 0}});
        roots.push_back(k);
    }
    file.json["nodes"] = nodes;
    file.json["scenes"][0]["nodes"] = roots;
    EXPECT_EQ(file.fault(),
              "the glTF file reads its data more often than a file of this size "
              "should");
}

}  // namespace
}  // namespace cascade
