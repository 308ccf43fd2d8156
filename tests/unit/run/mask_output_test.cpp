// What pictures, files and measurements have outside of a domain's mask.
#include "run_fixture.h"

#include "picture/grey_picture.h"
#include "run/emit_c/compile.h"
#include "run/pictures/measured.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace cascade {
namespace {

/// A disc of about 12 × 12 cells, in two stages.
constexpr const char* disc_in_two_stages = R"(
domain { grid: 20, 16; mask: disc(0.5, 0.4, 0.3) }
stage first: turing_spots { iterations: 60; interval: 20; ka: 0.2/16 }
stage second: turing_spots {
  iterations: 40
  a: a
  b: b
  beta: beta
  frozen: b < 4
  ka: 0.2/16
}
)";

bool is_inside(std::size_t cell) {
    const double x = (static_cast<double>(cell % 20) + 0.5) / 20;
    const double y = (static_cast<double>(cell / 20) + 0.5) / 20;
    return std::hypot(x - 0.5, y - 0.4) < 0.3;
}

/// The colour type of a PNG file: 4 more with alpha.
int colour_type(const std::string& file) { return file.size() > 25 ? file[25] : -1; }

TEST_F(RunTest, MaskedFilesHaveNanOutside) {
    Script script = load(disc_in_two_stages);
    RunRequest wanted = request();
    wanted.save = path("saved");
    run_well(script, wanted);
    for (const char* name : {"first.a", "second.b", "first.beta", "second.frozen"}) {
        const auto values = array(std::string("saved/") + name + ".npy");
        ASSERT_EQ(values.size(), 320u);
        for (std::size_t cell = 0; cell < values.size(); ++cell) {
            EXPECT_EQ(std::isfinite(values[cell]), is_inside(cell)) << name << " " << cell;
        }
    }
}

TEST_F(RunTest, MaskedRunsGoOnWhereTheyStopped) {
    Script whole = load(disc_in_two_stages);
    RunRequest wanted = request();
    wanted.save = path("whole");
    run_well(whole, wanted);

    Script stopped = load(disc_in_two_stages);
    wanted.save = path("part");
    wanted.stop_at = StopAt{"second", 13};
    EXPECT_EQ(run_well(stopped, wanted).status, RunStatus::stopped);
    auto resumed = load_saved_script(path("part"), {});
    ASSERT_TRUE(resumed);
    wanted.stop_at.reset();
    wanted.resume = path("part");
    wanted.save = path("rest");
    run_well(*resumed, wanted);
    EXPECT_EQ(bytes("whole/second.b.npy"), bytes("rest/second.b.npy"));
    EXPECT_EQ(bytes("whole/first.a.npy"), bytes("rest/first.a.npy"));
}

TEST_F(RunTest, ValuesOfTheDomainThatAreNotFiniteAreRefused) {
    Script script = load(disc_in_two_stages);
    RunRequest wanted = request();
    wanted.save = path("saved");
    wanted.stop_at = StopAt{"second", 13};
    run_well(script, wanted);
    auto resumed = load_saved_script(path("saved"), {});
    ASSERT_TRUE(resumed);
    const auto damaged = read_npy(path("saved/second.a.npy"));
    ASSERT_TRUE(damaged);
    Field values = to_field(*damaged);
    EXPECT_FALSE(std::isfinite(values.at(0, 0)));  // This cell is outside of the mask.
    values.at(10, 8) = values.at(0, 0);
    ASSERT_TRUE(write_npy(path("saved/second.a.npy"), values));
    // Saved runs of earlier versions have no checksums.
    auto manifest = nlohmann::json::parse(bytes("saved/run.json"));
    manifest.erase("files");
    ASSERT_TRUE(write_file(path("saved/run.json"), manifest.dump()));
    wanted.stop_at.reset();
    wanted.resume = path("saved");
    EXPECT_THAT(run_badly(*resumed, wanted),
                ::testing::HasSubstr("second.a.npy has a value that is not finite"));
}

#if CASCADE_HAS_JIT
TEST_F(RunTest, AMaskIsNotCompiledToAnObjectFile) {
    Script script = load(disc_in_two_stages);
    const auto compiled = compile_step(script, {});
    ASSERT_FALSE(compiled);
    EXPECT_THAT(compiled.error().message, ::testing::HasSubstr("a domain with a mask"));
}
#endif

TEST_F(RunTest, MaskedPicturesAreTransparentOutside) {
    Script script = load(disc_in_two_stages);
    RunRequest wanted = request();
    wanted.picture.range = ValueRange{1000, 2000};  // All cells inside are black.
    wanted.frames = path("frames");
    wanted.sheet = path("sheet.png");
    const RunReport report = run_well(script, wanted);
    EXPECT_EQ(colour_type(bytes("picture.png")), 4);
    const auto picture = read_grey_picture(path("picture.png"));  // On white.
    ASSERT_TRUE(picture);
    for (std::size_t cell = 0; cell < picture->values.size(); ++cell) {
        EXPECT_EQ(picture->values[cell], is_inside(cell) ? 0 : 1) << cell;
    }
    EXPECT_EQ(colour_type(bytes("sheet.png")), 2);
    bool has_frames = false;
    for (const auto& file : report.written) {
        if (file.parent_path().filename() != "frames") continue;
        EXPECT_EQ(colour_type(read_file(file, 1u << 20).value()), 4) << file;
        has_frames = true;
    }
    EXPECT_TRUE(has_frames);
}

TEST_F(RunTest, MaskedColoursAreTransparentOutside) {
    Script script = load(std::string(disc_in_two_stages) + "picture { color: rgb(1, 0, 0) }");
    run_well(script, request());
    EXPECT_EQ(colour_type(bytes("picture.png")), 6);
}

TEST_F(RunTest, TheRangeOfAPictureIsThatOfTheDomain) {
    Script script = load(
        "domain { grid: 8, 8; mask: x < 0.5 }\n"
        "system s { u: 5 + x; u' = 0 }\nstage only: s { iterations: 1 }");
    run_well(script, request());
    const auto picture = read_grey_picture(path("picture.png"));
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->values[0], 0);
    EXPECT_EQ(picture->values[3], 1);
}

TEST_F(RunTest, FeaturesAreOfTheDomain) {
    // Two islands, one of which has a spot. Values of the other cells of the islands are 0.
    Script script = load(
        "domain { grid: 40, 40; mask: disc(0.25, 0.25, 0.15) or disc(0.7, 0.7, 0.2) }\n"
        "system s { u: disc(0.7, 0.7, 0.1); u' = 0 }\n"
        "stage only: s { iterations: 1 }");
    RunRequest wanted = request();
    wanted.features = true;
    const RunReport report = run_well(script, wanted);
    ASSERT_TRUE(report.features);
    EXPECT_EQ(report.features->spots, 1);
    EXPECT_EQ(report.features->holes, 2);
    EXPECT_NEAR(report.features->area, 0.1 * 0.1 / (0.15 * 0.15 + 0.2 * 0.2), 0.01);
    EXPECT_EQ(report.features->mean, report.features->area);
}

TEST_F(RunTest, VolumesHideWhatIsOutside) {
    Script script = load(
        "domain { grid: 6, 5, 4; mask: x < 0.5 }\n"
        "system s { u: 1; u' = lap(u) }\nstage only: s { iterations: 2 }");
    RunRequest wanted = request();
    wanted.volume = path("volume.vti");
    run_well(script, wanted);
    EXPECT_THAT(bytes("volume.vti"), ::testing::HasSubstr("vtkGhostType"));
    EXPECT_EQ(colour_type(bytes("picture.png")), 4);
}

TEST_F(RunTest, ASurfaceHasHoles) {
    const auto texture_of = [&](const char* mask) {
        Script script = load(std::string("domain { grid: 48, 24; surface: sx, sy, 0") + mask +
                             " }\nsystem s { u: sx; u' = lap(u) }\n"
                             "stage only: s { iterations: 2; speed: 0.1 }");
        run_well(script, request());
        const auto picture = read_grey_picture(path("picture.png"));
        EXPECT_TRUE(picture);
        return picture ? picture->values : std::vector<float>();
    };
    const auto whole = texture_of(""), holed = texture_of("; mask: not disc(0.5, 0.25, 0.2)");
    ASSERT_EQ(whole.size(), holed.size());
    std::size_t different = 0;
    for (std::size_t pixel = 0; pixel < whole.size(); ++pixel) {
        if (std::abs(whole[pixel] - holed[pixel]) > 0.05F) ++different;
    }
    EXPECT_GT(different, whole.size() / 50);
    EXPECT_LT(different, whole.size() / 2);
}

TEST_F(RunTest, AMaskWithoutCellsIsAFault) {
    Script script = load(
        "domain { grid: 8, 8; mask: disc(1, 1, 0.1) * 0 }\n"
        "system s { u: 1; u' = 0 }\nstage only: s { }");
    run_badly(script, request());
    EXPECT_EQ(script.messages(false),
              "test.cascade:1:28: error: no cell is inside the mask\n"
              "    1 | domain { grid: 8, 8; mask: disc(1, 1, 0.1) * 0 }\n"
              "      |                            ^~~~~~~~~~~~~~~~~~~ cells where the mask is "
              "not 0 belong to the domain\n");
}

}  // namespace
}  // namespace cascade
