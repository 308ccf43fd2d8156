// Models that are sent in parts: complete, repeated, missing and hostile parts, and names of
// models.
#include "view/loaded_models.h"

#include "core/file.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

namespace fs = std::filesystem;

const std::string tetrahedron =
    "OFF 4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

class LoadedModelsTest : public testing::Test {
protected:
    void SetUp() override {
        fs::remove_all(base_);
        fs::create_directories(base_ / "loaded");
        fs::create_directories(base_ / "scripts");
        models_.emplace(base_ / "loaded", base_ / "scripts");
    }

    /// Sends a file in parts of `length` bytes, each of them twice, as after a lost connection.
    Result<std::string> load(const std::string& name, const std::string& bytes,
                             std::size_t length = 10) {
        Result<std::string> last;
        for (std::size_t at = 0; at < bytes.size(); at += length) {
            const LoadPart part{name, at, bytes.size(), bytes.substr(at, length)};
            last = models_->add(part);
            if (!last) return last;
            if (at == 0) continue;
            const auto again = models_->add(part);
            EXPECT_TRUE(again && *again == *last);
        }
        return last;
    }
    std::string refusal(const std::string& name, const std::string& bytes) {
        const auto loaded = load(name, bytes, 1 << 20);
        if (loaded) return "loaded as " + *loaded;
        EXPECT_TRUE(fs::is_empty(base_ / "loaded"));
        return loaded.error().message;
    }

    const fs::path base_ = fs::path(testing::TempDir()) / "cascade_loaded_models";
    std::optional<LoadedModels> models_;
};

TEST_F(LoadedModelsTest, AreKeptUnderTheirNames) {
    EXPECT_EQ(load("ball.off", tetrahedron), "ball.off");
    EXPECT_EQ(read_file(base_ / "loaded/ball.off", 1000), tetrahedron);
    EXPECT_EQ(load("ball.off", tetrahedron), "ball.off") << "the same bytes";
    EXPECT_EQ(load("ball.off", tetrahedron + "# another\n"), "ball-2.off");
    // A file beside the script keeps its name, so the loaded model gets another one.
    ASSERT_TRUE(write_file(base_ / "scripts/horse.off", "mine"));
    EXPECT_EQ(load("horse.off", tetrahedron), "horse-2.off");
    ASSERT_TRUE(write_file(base_ / "scripts/same.off", tetrahedron));
    EXPECT_EQ(load("same.off", tetrahedron), "same.off");
}

TEST_F(LoadedModelsTest, HaveNamesWithoutPathsAndSigns) {
    EXPECT_EQ(load("../../etc/a b\"\n{.OFF", tetrahedron), "a_b___.OFF");
    EXPECT_EQ(load("C:\\models\\..\\cube.off", tetrahedron), "cube.off");
    EXPECT_EQ(load(".off", tetrahedron), "model.off");
    EXPECT_EQ(load("Pf\u00e4rd.off", tetrahedron), "Pf__rd.off");
    EXPECT_EQ(load(std::string(9000, 'a') + ".off", tetrahedron)->size(), 80U);
    EXPECT_EQ(std::distance(fs::directory_iterator(base_), {}), 2) << "nothing lies beside";
}

TEST_F(LoadedModelsTest, AreRefusedInOneMessage) {
    EXPECT_THAT(refusal("notes.txt", "text"), testing::HasSubstr("is not a model"));
    EXPECT_THAT(refusal("..", "text"), testing::HasSubstr("is not a model"));
    EXPECT_THAT(refusal("a.off", "OFF 9 9 9\n1"), testing::HasSubstr("'a.off'"));
    EXPECT_THAT(refusal("a.glb", "glTF"), testing::HasSubstr("'a.glb'"));
    EXPECT_THAT(refusal("a.ply", tetrahedron), testing::HasSubstr("'a.ply'"));
    EXPECT_THAT(refusal("a.stl", std::string(84, '\0')), testing::HasSubstr("'a.stl'"));
    EXPECT_THAT(
        refusal(
            "a.gltf",
            R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "../../../etc/passwd"}]})"),
        testing::HasSubstr("'a.gltf'"));
}

TEST_F(LoadedModelsTest, AreBounded) {
    models_.emplace(base_ / "loaded", base_ / "scripts", LoadLimits{200, 300});
    const auto refused = [&](const LoadPart& part) { return models_->add(part).error().message; };
    EXPECT_THAT(refused({"a.ply", 0, 201, "ply"}), testing::HasSubstr("more than 200 bytes"));
    EXPECT_THAT(refused({"a.ply", 3, 10, "ply"}),
                testing::HasSubstr("parts of 'a.ply' are missing"));
    ASSERT_EQ(models_->add({"a.ply", 0, 10, "ply"}), "");
    EXPECT_THAT(refused({"b.ply", 3, 10, "ply"}), testing::HasSubstr("missing"));
    EXPECT_THAT(refused({"a.ply", 4, 10, "ply"}), testing::HasSubstr("missing"));
    EXPECT_THAT(refused({"a.ply", 3, 10, "12345678"}), testing::HasSubstr("longer"));
    // The total size of a session's models is limited.
    ASSERT_TRUE(load("a.off", tetrahedron + std::string(190 - tetrahedron.size(), '\n')));
    EXPECT_THAT(refused({"b.off", 0, 150, "OFF"}), testing::HasSubstr("at most 300 bytes"));
    LoadedModels none("", base_);
    EXPECT_FALSE(none.add({"a.off", 0, tetrahedron.size(), tetrahedron}));
}

}  // namespace
}  // namespace cascade
