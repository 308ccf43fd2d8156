// Files of copies: instances are decoded by the specification of the format, merged triangles by
// our own readers.
#include "export/instanced_model.h"
#include "export/group_colours.h"
#include "mesh/model_file.h"
#include "picture/srgb.h"
#include "unit/export/decoded_glb.h"
#include "unit/export/example_surfaces.h"
#include "unit/mesh/example_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace cascade {
namespace {

using test::Decoded;
using ::testing::HasSubstr;

/// Thorns of two forms on a sphere, in many colours.
Instances thorns(std::size_t count) {
    Instances copies;
    for (const double form : {0.3, 1.0}) {
        copies.meshes.push_back(test::thorn(form, 0.5, {1, 0.04}));
    }
    for (std::size_t k = 0; k < count; ++k) {
        const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
        const double height = 1 - 2 * part, angle = 2.4 * static_cast<double>(k);
        const double across = std::sqrt(1 - height * height);
        Placement copy;
        copy.mesh = static_cast<std::uint32_t>(k % 2);
        copy.place = {across * std::cos(angle), height, across * std::sin(angle)};
        const Vector3d x = unit(cross(copy.place, Vector3d{0.3, -1, 0.1}));
        copy.turn = quaternion_of(x, copy.place, cross(x, copy.place));
        copy.scale = Vector3d{0.02, 0.05 + 0.01 * part, 0.02};
        copy.colour = {static_cast<float>(part), static_cast<float>(0.5 + 0.5 * std::sin(angle)),
                       0.25F};
        copies.placements.push_back(copy);
    }
    return copies;
}

/// A copy of a mesh, as read from a file.
struct Found {
    Vector3d place, scale;
    Quaternion turn;
    Colour light, light_of_material;
    std::size_t triangles = 0;
};

std::vector<Found> copies_in(const Decoded& file) {
    std::vector<Found> found;
    for (const auto& node : file.json["nodes"]) {
        if (!node.contains("extensions")) continue;
        const auto& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        const auto places = file.numbers(attributes["TRANSLATION"]);
        const auto turns = file.numbers(attributes["ROTATION"]);
        const auto scales = file.numbers(attributes["SCALE"]);
        const auto colours = file.numbers(attributes["_COLOR_0"]);
        const auto& primitive =
            file.json["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
        const auto& material = file.json["materials"][primitive["material"].get<std::size_t>()];
        const auto& base = material["pbrMetallicRoughness"]["baseColorFactor"];
        Vector3d origin;
        if (node.contains("translation")) {
            origin = {node["translation"][0], node["translation"][1], node["translation"][2]};
        }
        for (std::size_t k = 0; k < places.size() / 3; ++k) {
            Found copy;
            copy.place = Vector3d{places[3 * k], places[3 * k + 1], places[3 * k + 2]} + origin;
            copy.scale = {scales[3 * k], scales[3 * k + 1], scales[3 * k + 2]};
            copy.turn = {turns[4 * k + 3], turns[4 * k], turns[4 * k + 1], turns[4 * k + 2]};
            for (std::size_t c = 0; c < 3; ++c) {
                copy.light_of_material[c] = base[c].get<float>();
                copy.light[c] = base[c].get<float>() * static_cast<float>(colours[3 * k + c]);
            }
            copy.triangles = file.numbers(primitive["indices"]).size() / 3;
            found.push_back(copy);
        }
    }
    return found;
}

TEST(InstancedModel, FilesHaveEachCopy) {
    const Instances copies = thorns(500);
    const Result<std::string> bytes = encode_instanced_glb({nullptr, {}, copies});
    ASSERT_TRUE(bytes);
    const Decoded file(*bytes);
    EXPECT_EQ(file.json["extensionsRequired"][0], "EXT_mesh_gpu_instancing");
    EXPECT_LE(file.json["materials"].size(), most_copy_materials);
    const std::vector<Found> found = copies_in(file);
    ASSERT_EQ(found.size(), 500u);
    for (const Placement& copy : copies.placements) {
        const auto same = std::find_if(found.begin(), found.end(), [&](const Found& each) {
            return length(each.place - copy.place) < 1e-6;
        });
        ASSERT_NE(same, found.end());
        EXPECT_EQ(same->triangles, copies.meshes[copy.mesh].triangles.size());
        EXPECT_LT(length(same->scale - copy.scale), 1e-8);
        // The length of a rounded quaternion is not exactly 1, and readers may not normalise it.
        // The error is far below a pixel.
        for (const Vector3d axis : {Vector3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
            EXPECT_LT(length(turned(same->turn, axis) - turned(copy.turn, axis)), 2e-4);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(same->light[c], light_of(copy.colour)[c], 1e-5);
            EXPECT_NEAR(stored_of(same->light_of_material)[c], copy.colour[c], 0.2);
        }
    }
}

TEST(InstancedModel, TenThousandThornsAreFarBelowAMegabyte) {
    const Result<std::string> bytes = encode_instanced_glb({nullptr, {}, thorns(10000)});
    ASSERT_TRUE(bytes);
    EXPECT_LT(bytes->size(), 550000u);
}

TEST(InstancedModel, AFewColoursAreExactInTheMaterials) {
    Instances copies = thorns(90);
    for (std::size_t k = 0; k < 90; ++k) {
        copies.placements[k].colour = {k % 3 == 0 ? 0.8F : 0, k % 3 == 1 ? 0.5F : 0, 0};
    }
    const Decoded file(*encode_instanced_glb({nullptr, {}, copies}));
    EXPECT_EQ(file.json["materials"].size(), 3u);
    // Each colour has two meshes. Vertices are stored once for each mesh, not for each colour.
    EXPECT_EQ(file.json["nodes"].size(), 6u);
    std::set<int> positions;
    for (const auto& mesh : file.json["meshes"]) {
        positions.insert(mesh["primitives"][0]["attributes"]["POSITION"].get<int>());
    }
    EXPECT_EQ(positions.size(), 2u);
    for (const Found& copy : copies_in(file)) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(copy.light[c], copy.light_of_material[c], 1e-7);
        }
    }
}

TEST(InstancedModel, BodiesKeepTheirColoursAndPlaces) {
    SurfaceMesh body = test::sphere_with_texture(9);
    const Vector3d far{1e7 + 1.0 / 3, 0, 0};
    for (Vector3d& p : body.points) p = p + far;
    Instances copies = thorns(20);
    move_instances(copies, -far, 1);
    const std::vector<Colour> colours(body.points.size(), Colour{0.2F, 0.4F, 0.6F});
    const Decoded file(*encode_instanced_glb({&body, colours, copies}));
    EXPECT_TRUE(file.json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
    for (const Found& copy : copies_in(file)) EXPECT_NEAR(length(copy.place - far), 1, 1e-6);
    for (const double part :
         file.numbers(file.json["meshes"][1]["primitives"][0]["attributes"]["POSITION"])) {
        EXPECT_LT(std::abs(part), 2);
    }
}

TEST(InstancedModel, MergedCopiesAreReadBack) {
    const SurfaceMesh body = test::sphere_with_texture(8);
    const std::vector<Colour> colours(body.points.size(), Colour{0.2F, 0.4F, 0.6F});
    const Instances copies = thorns(30);
    const InstancedModel model{&body, colours, copies};
    const std::size_t triangles = body.triangles.size() + copies.triangle_count();
    const Result<PolygonSoup> glb = read_gltf(*encode_merged_glb(model));
    ASSERT_TRUE(glb) << glb.error().message;
    EXPECT_EQ(glb->polygon_count(), triangles);
    const std::string text = *encode_merged_obj(model);
    EXPECT_THAT(text, HasSubstr("\no body\n"));
    const Result<PolygonSoup> obj = read_obj(text);
    ASSERT_TRUE(obj) << obj.error().message;
    EXPECT_EQ(obj->polygon_count(), triangles);
    // In both files, the last triangle belongs to the last copy.
    const Placement& last = copies.placements.back();
    const TriangleMesh& mesh = copies.meshes[last.mesh];
    const PlacementMap map(last);
    for (const Result<PolygonSoup>* soup : {&glb, &obj}) {
        const auto corners = (*soup)->polygon(triangles - 1);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3 wanted = map.point(mesh.positions[mesh.triangles.back()[k]]);
            const Vector3d found = (*soup)->points[corners[k]];
            EXPECT_LT(length(found - Vector3d{wanted.x, wanted.y, wanted.z}), 1e-6);
        }
    }
}

TEST(InstancedModel, ShadesDarkenMergedColours) {
    Instances copies = thorns(1);
    copies.meshes[0].shades.assign(copies.meshes[0].positions.size(), 0.5F);
    copies.placements[0].colour = {0.8F, 0.6F, 1};
    const Result<MergedCopies> merged = merge_copies(copies);
    ASSERT_TRUE(merged);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(light_of(merged->colours[0])[c], light_of(copies.placements[0].colour)[c] / 2,
                    1e-5);
    }
}

TEST(InstancedModel, TooManyTrianglesAreNotMerged) {
    Instances copies = thorns(17);
    for (TriangleMesh& mesh : copies.meshes) mesh.triangles.resize(std::size_t{1} << 20);
    const Result<MergedCopies> merged = merge_copies(copies);
    ASSERT_FALSE(merged);
    EXPECT_EQ(merged.error().message,
              "17 copies have 17,825,792 triangles in total, but at most 16,777,216 can be merged");
    EXPECT_EQ(merged.error().hint, "leave --merge out, or use coarser shapes");
}

TEST(InstancedModel, Binary32MustHoldIt) {
    Instances copies = thorns(2);
    move_instances(copies, {}, 1e40);
    const Result<std::string> bytes = encode_instanced_glb({nullptr, {}, copies});
    ASSERT_FALSE(bytes);
    EXPECT_THAT(bytes.error().message, HasSubstr("does not fit into a GLB file"));
    EXPECT_EQ(bytes.error().hint, "scale the model");
}

TEST(InstancedModel, EndingsChooseTheFormat) {
    const Instances copies = thorns(2);
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / "cascade_instanced_model";
    std::filesystem::create_directories(folder);
    const auto first_bytes = [&](const char* name, bool is_merged) {
        EXPECT_TRUE(write_instanced(folder / name, {nullptr, {}, copies}, is_merged));
        std::string text(2000, '\0');
        std::ifstream(folder / name, std::ios::binary).read(text.data(), 2000);
        return text;
    };
    EXPECT_THAT(first_bytes("a.OBJ", false), HasSubstr("o copies"));
    EXPECT_THAT(first_bytes("a.glb", false), HasSubstr("EXT_mesh_gpu_instancing"));
    EXPECT_THAT(first_bytes("a.glb", true), ::testing::Not(HasSubstr("EXT_mesh")));
    const Result<void> refused = write_instanced(folder / "a.ply", {nullptr, {}, copies}, true);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("ends in .obj or .glb"));
    std::filesystem::remove_all(folder);
}

TEST(GroupColours, GroupsAreSmallAndFew) {
    std::vector<Colour> colours;
    for (int k = 0; k < 1000; ++k) {
        colours.push_back({static_cast<float>(k % 10) / 9, static_cast<float>(k / 10 % 10) / 9,
                           static_cast<float>(k / 100) / 9});
    }
    const ColourGroups groups = group_colours(colours, 64);
    EXPECT_EQ(groups.means.size(), 64u);
    for (std::size_t k = 0; k < colours.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_LE(std::abs(groups.means[groups.group[k]][c] - colours[k][c]), 0.25F);
        }
    }
    EXPECT_EQ(group_colours(std::vector<Colour>(5, Colour{0.5F, 0, 1}), 8).means,
              (std::vector<Colour>{{0.5F, 0, 1}}));
    EXPECT_TRUE(group_colours({}, 8).means.empty());
}

}  // namespace
}  // namespace cascade
