// Model files that are broken in many ways: each gets one clear message or is read correctly.
#include "mesh/model_file.h"
#include "support/model_faults.h"
#include "support/random_stream.h"
#include "support/small_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace cascade {
namespace {

using test::bytes_of;
using test::RandomStream;
using test::SmallModel;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// "" if the file becomes a surface, otherwise the message. The test fails if the surface is
/// inconsistent.
std::string outcome_of_bytes(std::string_view bytes, std::string_view ending) {
    auto soup = read_model_bytes(bytes, ending);
    if (!soup) return soup.error().message.empty() ? "NO MESSAGE" : soup.error().message;
    if (const char* fault = test::fault_of_soup(*soup)) ADD_FAILURE() << fault;
    const auto made = make_mesh(*std::move(soup));
    if (!made) return made.error().message.empty() ? "NO MESSAGE" : made.error().message;
    if (const char* fault = test::fault_of_mesh(made->mesh)) ADD_FAILURE() << fault;
    return "";
}

std::string outcome_of_file(const std::filesystem::path& path) {
    const auto soup = read_model(path);
    return soup ? "" : soup.error().message;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string bytes_called(std::string_view name) {
    for (const SmallModel& model : test::small_models()) {
        if (model.name == name) return model.bytes;
    }
    ADD_FAILURE() << name;
    return "";
}

/// Flips bits, cuts off ends, doubles parts and replaces numbers by hostile ones.
std::string mutated(std::string bytes, RandomStream& random) {
    constexpr std::array<std::string_view, 12> numbers = {
        "0",   "-1",  "4294967295", "4294967296", "18446744073709551616",   "1e400", "-1e-400",
        "nan", "inf", "2147483648", "0.5",        "99999999999999999999999"};
    const std::uint32_t changes = 1 + random.below(4);
    for (std::uint32_t k = 0; k < changes && !bytes.empty(); ++k) {
        const std::size_t at = random.below(bytes.size());
        switch (random.below(5)) {
            case 0: bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.below(8)); break;
            case 1: bytes.resize(at); break;
            case 2:
                bytes.insert(at, bytes.substr(random.below(bytes.size()), random.below(40)));
                break;
            case 3: bytes.erase(at, 1 + random.below(8)); break;
            default: {
                const std::size_t digit = bytes.find_first_of("0123456789", at);
                if (digit == std::string::npos) break;
                const std::size_t end = bytes.find_first_not_of("0123456789.", digit);
                bytes.replace(digit, std::min(end, bytes.size()) - digit,
                              numbers[random.below(numbers.size())]);
            }
        }
    }
    return bytes;
}

TEST(HostileModels, WholeSmallModelsAreRead) {
    for (const SmallModel& model : test::small_models()) {
        EXPECT_EQ(outcome_of_bytes(model.bytes, model.ending), "") << model.name;
    }
}

TEST(HostileModels, MutatedModelsAreReadOrRefused) {
    std::size_t read = 0, refused = 0;
    for (const SmallModel& model : test::small_models()) {
        RandomStream random(42 + model.bytes.size());
        for (int k = 0; k < 400; ++k) {
            const std::string bytes = mutated(model.bytes, random);
            const std::string outcome = outcome_of_bytes(bytes, model.ending);
            EXPECT_NE(outcome, "NO MESSAGE") << model.name;
            EXPECT_FALSE(::testing::Test::HasFailure()) << model.name << " " << k << "\n" << bytes;
            if (::testing::Test::HasFailure()) return;
            ++(outcome.empty() ? read : refused);
        }
    }
    EXPECT_GT(read, 300u);
    EXPECT_GT(refused, 1000u);
}

TEST(HostileModels, EveryPrefixIsReadOrRefused) {
    for (const SmallModel& model : test::small_models()) {
        for (std::size_t size = 0; size < model.bytes.size(); ++size) {
            EXPECT_NE(outcome_of_bytes(model.bytes.substr(0, size), model.ending), "NO MESSAGE");
        }
    }
    // A truncated file is noticed if the format allows it.
    for (const std::string_view name :
         {"PLY text", "PLY little-endian", "OFF", "STL text", "STL binary", "glTF", "GLB"}) {
        const std::string bytes = bytes_called(name);
        for (const SmallModel& model : test::small_models()) {
            if (model.name != name) continue;
            EXPECT_NE(outcome_of_bytes(bytes.substr(0, bytes.size() - 8), model.ending), "")
                << name;
        }
    }
}

TEST(HostileModels, GarbageOfEveryFormat) {
    RandomStream random(7);
    for (int k = 0; k < 60; ++k) {
        std::string garbage;
        for (std::uint32_t size = random.below(600); size > 0; --size) {
            garbage += static_cast<char>(random.below(256));
        }
        for (const std::string_view ending : {"ply", "obj", "off", "stl", "gltf", "glb"}) {
            EXPECT_THAT(outcome_of_bytes(garbage, ending), Not(AnyOf("", "NO MESSAGE")));
        }
    }
    for (const std::string_view ending : {"ply", "obj", "off", "stl", "gltf", "glb"}) {
        EXPECT_THAT(outcome_of_bytes("", ending), Not(AnyOf("", "NO MESSAGE")));
    }
}

TEST(HostileModels, CountsThatLie) {
    EXPECT_THAT(outcome_of_bytes(replaced(bytes_called("PLY text"), "face 2", "face 2000000000"),
                                 "ply"),
                HasSubstr("too short for 2000000000 elements 'face'"));
    EXPECT_THAT(outcome_of_bytes(replaced(bytes_called("PLY text"), "3 0 2 1", "4000000 0 2 1"),
                                 "ply"),
                HasSubstr("ends too early"));
    EXPECT_THAT(outcome_of_bytes(replaced(bytes_called("OFF"), "4 4 6", "4 4000000 6"), "off"),
                HasSubstr("too short for 4 points and 4000000 faces"));
    EXPECT_THAT(outcome_of_bytes(replaced(bytes_called("OFF"), "3 0 2 1", "4000000000 0 2 1"),
                                 "off"),
                HasSubstr("line 8 of the OFF file is not a face"));
    std::string stl = bytes_called("STL binary");
    stl.replace(80, 4, bytes_of(std::uint32_t{4000000000}));
    EXPECT_EQ(outcome_of_bytes(stl, "stl"),
              "the STL file is 184 bytes long, but its 4000000000 triangles take 200000000084");
    EXPECT_THAT(outcome_of_bytes(
                    replaced(test::gltf_text(), R"("byteLength":42)", R"("byteLength":0)"), "gltf"),
                HasSubstr("not a glTF file that can be read"));
    std::string glb = bytes_called("GLB");
    glb.replace(8, 4, bytes_of(std::uint32_t{4000000000}));
    EXPECT_THAT(outcome_of_bytes(glb, "glb"), HasSubstr("it has at least 4000000000"));
}

TEST(HostileModels, NumbersThatAreNoPlaces) {
    EXPECT_EQ(outcome_of_bytes(replaced(bytes_called("PLY text"), "1 0 0 0 1 0", "nan 0 0 0 1 0"),
                               "ply"),
              "point 1 of the model, counted from 0, has the position (nan, 0, 0)");
    EXPECT_EQ(outcome_of_bytes(replaced(bytes_called("PLY text"), "1 0 0 0 1 0", "1 0 1e999 0 1 0"),
                               "ply"),
              "point 1 of the model, counted from 0, has the position (1, 0, inf)");
    EXPECT_EQ(outcome_of_bytes(
                  replaced(bytes_called("PLY text"), "1 0 0 0 1 0", "1 0 1e-999 0 1 0"), "ply"),
              "");
    EXPECT_EQ(outcome_of_bytes(replaced(bytes_called("OBJ"), "v 1 0 0", "v NaN 0 0"), "obj"),
              "point 1 of the model, counted from 0, has the position (nan, 0, 0)");
    EXPECT_EQ(outcome_of_bytes(replaced(bytes_called("OBJ"), "v 1 0 0", "v one 0 0"), "obj"),
              "line 3 of the OBJ file is not the position of a point");
    EXPECT_EQ(outcome_of_bytes(replaced(bytes_called("STL text"), "vertex 1 0 0", "vertex 1 0"),
                               "stl"),
              "line 5 of the STL file is not a corner of a triangle");
    EXPECT_EQ(outcome_of_bytes(
                  replaced(bytes_called("STL text"), "vertex 1 0 0", "vertex -inf 0 0"), "stl"),
              "point 1 of the model, counted from 0, has the position (-inf, 0, 0)");
    std::string stl = bytes_called("STL binary");
    stl.replace(96, 4, bytes_of(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_EQ(outcome_of_bytes(stl, "stl"),
              "point 0 of the model, counted from 0, has the position (nan, 0, 0)");
}

TEST(HostileModels, CornersThatAreNoPoints) {
    for (const std::string_view corner : {"5", "-5", "0", "x", "99999999999999999999", "1.5"}) {
        const std::string outcome = outcome_of_bytes(
            replaced(bytes_called("OBJ"), "f 1/1 2/2 4/3", "f " + std::string(corner) + " 2/2 4/3"),
            "obj");
        EXPECT_THAT(outcome, HasSubstr("of the OBJ file")) << corner;
    }
    EXPECT_THAT(outcome_of_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/1\n", "obj"),
                HasSubstr("face 1 of the OBJ file names a texture coordinate that does not exist"));
    EXPECT_THAT(outcome_of_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf /1 2 3\n", "obj"),
                HasSubstr("line 4 of the OBJ file is not a face of points"));
    EXPECT_THAT(outcome_of_bytes(replaced(bytes_called("OFF"), "3 0 2 1", "3 0 2 -1"), "off"),
                HasSubstr("line 8 of the OFF file is not a face"));
}

TEST(HostileModels, OneTriangleAndNone) {
    EXPECT_EQ(outcome_of_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "obj"), "");
    EXPECT_EQ(outcome_of_bytes("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "obj"),
              "the model's faces have no area");
    EXPECT_EQ(outcome_of_bytes("v 0 0 0\n", "obj"), "the model's faces have no area");
    EXPECT_EQ(outcome_of_bytes(std::string(80, 'x') + bytes_of(std::uint32_t{0}), "stl"),
              "the model's faces have no area");
}

TEST(HostileModels, ModelsOfAllSizes) {
    for (const double size : {1e-30, 1e-9, 1e9, 1e30}) {
        std::string text;
        for (const Vector3d p : {Vector3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
            text += "v " + std::to_string(p.x) + "e" +
                    std::to_string(static_cast<int>(std::log10(size))) + " " +
                    std::to_string(p.y * size * 1e60) + "e-60 " +
                    std::to_string(p.z * size * 1e60) + "e-60\n";
        }
        auto soup = read_obj(text + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
        ASSERT_TRUE(soup);
        const auto made = make_mesh(*std::move(soup));
        ASSERT_TRUE(made) << made.error().message;
        EXPECT_NEAR(facts_of(made->mesh).area / (size * size), 1.5 + std::sqrt(0.75), 1e-6);
        EXPECT_EQ(facts_of(made->mesh).euler_characteristic, 2);
    }
}

TEST(HostileModels, NestingAndCopiesWithoutEnd) {
    std::string nested = test::gltf_text();
    nested.insert(1, R"("extras":)" + std::string(200000, '[') + std::string(200000, ']') + ",");
    EXPECT_EQ(outcome_of_bytes(nested, "gltf"), "the glTF file nests more than 128 lists");
    // Brackets inside strings do not count.
    std::string quoted = test::gltf_text();
    quoted.insert(1, R"("extras":"\")" + std::string(300, '[') + R"(",)");
    EXPECT_EQ(outcome_of_bytes(quoted, "gltf"), "");
    // A node with two parents occurs twice, its child with two such parents four times, and so on.
    std::string nodes = R"("nodes":[)";
    for (int k = 1; k <= 40; ++k) {
        nodes += R"({"children":[)" + std::to_string(k) + "," + std::to_string(k) + "]},";
    }
    EXPECT_EQ(outcome_of_bytes(replaced(test::gltf_text(),
                                        R"("nodes":[{"scale":[2,2,2],"children":[1]},{)",
                                        nodes + "{"),
                               "gltf"),
              "the nodes of the glTF file do not form a tree");
}

TEST(HostileModels, StripsAndFans) {
    for (const std::string_view mode : {R"("mode":5,)", R"("mode":6,)"}) {
        const auto soup =
            read_gltf(test::gltf_text(std::string(R"("indices":1,)") + std::string(mode)));
        ASSERT_TRUE(soup);
        EXPECT_THAT(soup->polygon(0), ElementsAre(0, 1, 2));
    }
}

TEST(HostileModels, LinesThatGoOn) {
    const auto soup = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 \\\n 0\nf 1 \\\r\n2 3\n");
    ASSERT_TRUE(soup) << soup.error().message;
    EXPECT_THAT(soup->polygon(0), ElementsAre(0, 1, 2));
}

TEST(HostileModels, PlyElementsTwiceAndUnevenTexture) {
    EXPECT_EQ(outcome_of_bytes(
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                  "property float z\nproperty float a\nelement vertex 1\nproperty float x\n"
                  "end_header\n0 0 0 1\n2\n",
                  "ply"),
              "the PLY file has several elements 'vertex'");
    // As many texture coordinates as corners in all, but not in each face.
    const auto soup = read_ply(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        "3 0 1 2 8 0 0 1 0 0 1 1 1\n3 0 1 3 4 0 0 1 0\n");
    ASSERT_TRUE(soup) << soup.error().message;
    EXPECT_TRUE(soup->texture.empty());
}

TEST(HostileModels, WhatIsNoFile) {
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / "hostile_models";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "folder.obj");
    EXPECT_THAT(outcome_of_file(folder / "missing.obj"), HasSubstr("No such file"));
    EXPECT_THAT(outcome_of_file(folder / "folder.obj"), HasSubstr("Is a directory"));
    ASSERT_EQ(::mkfifo((folder / "pipe.obj").c_str(), 0600), 0);
    EXPECT_THAT(outcome_of_file(folder / "pipe.obj"),
                HasSubstr("is a pipe or a device, not a file"));
    std::filesystem::create_symlink("/dev/zero", folder / "zero.stl");
    EXPECT_THAT(outcome_of_file(folder / "zero.stl"),
                HasSubstr("is a pipe or a device, not a file"));
    std::ofstream(folder / "empty.stl").close();
    EXPECT_THAT(outcome_of_file(folder / "empty.stl"), HasSubstr("the file is empty"));
    // A buffer in a file of its own that is a pipe, a folder, missing, or the right one.
    const std::string text = test::gltf_text();
    const std::size_t begin = text.find("data:"), end = text.find('"', begin);
    for (const auto& [name, wanted] : {std::pair{"pipe.obj", "'pipe.obj' is a pipe"},
                                       {"folder.obj", "Is a directory"},
                                       {"$(echo x)", "cannot read '$(echo x)': No such file"},
                                       {"empty.stl", "not a glTF file"}}) {
        std::string file = text;
        std::ofstream(folder / "buffer.gltf") << file.replace(begin, end - begin, name);
        EXPECT_THAT(outcome_of_file(folder / "buffer.gltf"), HasSubstr(wanted)) << name;
    }
    std::ofstream(folder / "triangle.bin")
        << std::string(36, '\0') << std::string("\0\0\1\0\2\0", 6);
    std::string file = text;
    std::ofstream(folder / "buffer.gltf") << file.replace(begin, end - begin, "triangle.bin");
    EXPECT_EQ(outcome_of_file(folder / "buffer.gltf"), "");
}

TEST(HostileModels, BuffersLieBelowTheModelsFolder) {
    const std::filesystem::path root =
        std::filesystem::path(::testing::TempDir()) / "foreign_buffers";
    std::filesystem::remove_all(root);
    std::filesystem::create_directories(root / "models");
    const std::string triangle = std::string(36, '\0') + std::string("\0\0\1\0\2\0", 6);
    std::ofstream(root / "key.bin") << triangle;
    std::ofstream(root / "size.bin") << triangle << "more";
    std::filesystem::create_symlink("../key.bin", root / "models/link.bin");
    const std::string text = test::gltf_text();
    const std::size_t begin = text.find("data:"), end = text.find('"', begin);
    const auto outcome = [&](const std::string& uri) {
        std::string file = text;
        std::ofstream(root / "models/thief.gltf") << file.replace(begin, end - begin, uri);
        return outcome_of_file(root / "models/thief.gltf");
    };
    for (const std::string& uri :
         {std::string("../key.bin"), std::string("%2e%2e/key.bin"), std::string("../size.bin"),
          std::string("link.bin"), (root / "key.bin").string(), std::string("../none.bin")}) {
        EXPECT_THAT(outcome(uri), HasSubstr("lies outside of the model's folder")) << uri;
        EXPECT_THAT(outcome(uri), ::testing::Not(HasSubstr("46"))) << uri;
    }
    // The user may grant the folder.
    outcome("../key.bin");
    EXPECT_TRUE(read_model(root / "models/thief.gltf", ReadAccess{false, {root}}));
    // A model that a script names may read the script's granted files.
    const auto by_script = read_model(GrantedFiles(root, {}), "models/thief.gltf");
    EXPECT_TRUE(by_script) << by_script.error().message;
}

}  // namespace
}  // namespace cascade
