// Small glTF files that would become large models or large objects in memory are refused early.
#include "mesh/model_file.h"
#include "tests/support/limited_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

using ::testing::HasSubstr;

std::string outcome(const std::string& gltf) {
    return test::in_limited_memory(std::uint64_t{64} << 20, [&] {
        const auto soup = read_gltf(gltf);
        return soup ? "a model" : soup.error().message;
    });
}

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int k = 0; k < count; ++k) all += (k > 0 ? "," : "") + text;
    return all;
}

/// A file with these parts, and with 900 bytes of coordinates for 300 points.
std::string with_nodes(const std::string& nodes, const std::string& primitives,
                       const std::string& roots) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots +
           R"(]}],"nodes":[)" + nodes + R"(],"meshes":[{"primitives":[)" + primitives +
           R"(]}],"accessors":[{"bufferView":0,"componentType":5121,"count":300,"type":"VEC3"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":900}],)"
           R"("buffers":[{"byteLength":900,"uri":"data:application/octet-stream;base64,)" +
           std::string(1200, 'A') + "\"}]}";
}

TEST(ModelBomb, WhatIsPlacedAgainAndAgainIsBoundedByTheFilesSize) {
    const std::string primitive = R"({"attributes":{"POSITION":0}})", node = R"({"mesh":0})";
    EXPECT_EQ(outcome(with_nodes(node, repeated(primitive, 100), "0")), "a model");
    EXPECT_THAT(outcome(with_nodes(node, repeated(primitive, 3000), "0")),
                HasSubstr("points, too many for its size"));
    std::string roots;
    for (int k = 0; k < 3000; ++k) roots += (k > 0 ? "," : "") + std::to_string(k);
    EXPECT_THAT(outcome(with_nodes(repeated(node, 3000), repeated(primitive, 100), roots)),
                HasSubstr("too many for its size"));
}

/// The data are used as positions of copies, so that each node has 300 copies.
TEST(ModelBomb, CopiesAreBoundedByTheFilesSize) {
    const std::string node =
        R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}})";
    const std::string primitive = R"({"attributes":{"POSITION":0}})";
    EXPECT_EQ(outcome(with_nodes(node, primitive, "0")), "a model");
    EXPECT_THAT(outcome(with_nodes(node, repeated(primitive, 40), "0")),
                HasSubstr("too many for its size"));
    std::string roots;
    for (int k = 0; k < 100; ++k) roots += (k > 0 ? "," : "") + std::to_string(k);
    EXPECT_THAT(outcome(with_nodes(repeated(node, 100), primitive, roots)),
                HasSubstr("too many for its size"));
}

TEST(ModelBomb, ObjectsOfTwoBytesAreCounted) {
    const std::string nodes = repeated("{}", 400'000);
    EXPECT_THAT(outcome(with_nodes(nodes, "{}", "0")),
                HasSubstr("more objects than a model needs"));
    const std::string numbers = R"({"extras":[)" + repeated("0", 2'000'000) + "]}";
    EXPECT_THAT(outcome(with_nodes(numbers, "{}", "0")),
                HasSubstr("more objects than a model needs"));
    // Files that are not refused need no more memory than the limit.
    EXPECT_NE(outcome(with_nodes(repeated("{}", 40'000), "{}", "0")), "died");
}

}  // namespace
}  // namespace cascade
