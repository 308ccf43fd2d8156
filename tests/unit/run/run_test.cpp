#include "run_fixture.h"

#include "core/file.h"
#include "picture/image.h"
#include "run/script/embedded_script.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

TEST_F(RunTest, SavesEveryFieldOfEveryStage) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.save = path("saved");
    const RunReport report = run_well(script, wanted);
    EXPECT_EQ(report.status, RunStatus::finished);
    EXPECT_EQ(report.steps, 500);
    for (const char* name :
         {"large.a", "large.b", "large.beta", "small.a", "small.b", "small.beta", "small.frozen"}) {
        const auto read = read_npy(path(std::string("saved/") + name + ".npy"));
        ASSERT_TRUE(read) << name;
        EXPECT_EQ(read->rows, 18);
        EXPECT_EQ(read->columns, 24);
    }
}

TEST_F(RunTest, FrozenCellsKeepTheirValues) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.save = folder_;
    run_well(script, wanted);
    const auto frozen = array("small.frozen.npy");
    const auto before = array("large.b.npy");
    const auto after = array("small.b.npy");
    int frozen_cells = 0, moved_cells = 0;
    for (std::size_t c = 0; c < frozen.size(); ++c) {
        EXPECT_EQ(frozen[c], before[c] < 4 ? 1.0F : 0.0F);
        if (frozen[c] != 0) {
            EXPECT_EQ(after[c], 4.0F);
            ++frozen_cells;
        } else if (after[c] != before[c]) {
            ++moved_cells;
        }
    }
    EXPECT_GT(frozen_cells, 10);
    EXPECT_GT(moved_cells, 10);
}

TEST_F(RunTest, APictureRunsAgain) {
    Overrides overrides;
    overrides.sets = {"small.ka=1/50"};
    overrides.seed = 9;
    Script script = load(two_stages, overrides);
    RunRequest wanted = request();
    wanted.picture.palette = "viridis";
    wanted.picture.show = "a - large.a";
    wanted.picture.scale = 2;
    run_well(script, wanted);

    auto again = load_script_file(path("picture.png"));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->script.overrides, overrides);
    RunRequest repeated = request();
    repeated.outputs = {path("again.png")};
    repeated.picture = *picture_request_from_json(again->picture_options);
    run_well(again->script, repeated);
    ASSERT_FALSE(bytes("picture.png").empty());
    EXPECT_EQ(bytes("picture.png"), bytes("again.png"));
}

TEST_F(RunTest, ResumesInMidStageWithTheSameBits) {
    Script whole = load(two_stages);
    RunRequest wanted = request();
    wanted.save = path("whole");
    run_well(whole, wanted);
    for (const StopAt& stop : {StopAt{"large", 137}, StopAt{"small", 0}, StopAt{"small", 61}}) {
        Script part = load(two_stages);
        RunRequest first = request();
        first.save = path("part");
        first.stop_at = stop;
        EXPECT_EQ(run_well(part, first).status, RunStatus::stopped);

        auto rest = load_saved_script(path("part"), {});
        ASSERT_TRUE(rest) << rest.error().message;
        RunRequest second = request();
        second.resume = path("part");
        second.save = path("rest");
        EXPECT_EQ(run_well(*rest, second).status, RunStatus::finished);
        for (const char* name : {"large.a.npy", "large.b.npy", "small.a.npy", "small.b.npy"}) {
            EXPECT_EQ(bytes(std::string("whole/") + name), bytes(std::string("rest/") + name))
                << name << " after a stop at " << stop.stage << ":" << stop.step;
        }
    }
}

TEST_F(RunTest, ResumeRefusesAnotherGridAndAFolderWithoutARun) {
    Overrides other;
    other.grid = {10, 10};
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.save = path("saved");
    run_well(script, wanted);
    EXPECT_EQ(load_saved_script(path("saved"), other).error().message,
              "a resumed run cannot change its grid, seed, precision, rounding, parameters or "
              "solver");
    EXPECT_NE(load_saved_script(path("nothing"), {}).error().message.find("holds no saved run"),
              std::string::npos);
}

TEST_F(RunTest, ReadsAFieldAsStartingValue) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.save = folder_;
    run_well(script, wanted);

    Script reader = load(
        "domain { grid: 24, 18 }\n"
        "stage s: turing_spots { iterations: 0; b: field(\"small.b.npy\") }\n");
    RunRequest second = request();
    second.save = path("second");
    run_well(reader, second);
    EXPECT_EQ(bytes("small.b.npy"), bytes("second/s.b.npy"));
}

TEST_F(RunTest, ReadsAPictureAsStartingValue) {
    Image image(4, 2);
    for (std::size_t k = 0; k < 8; ++k)
        image.pixels[k] = k % 4 < 2 ? Colour{1, 1, 1} : Colour{0, 0, 0};
    ASSERT_TRUE(write_png(path("half.png"), image, PngDepth::eight, {}));
    Script script = load(
        "domain { grid: 8, 6; boundary: noflux }\n"
        "system s { u: 0; u' = 0 * u }\n"
        "stage one: s { iterations: 0; u: 3 * image(\"half.png\") + image(\"half.png\") }\n");
    RunRequest wanted = request();
    wanted.save = folder_;
    run_well(script, wanted);
    const Result<NpyArray> array = read_npy(path("one.u.npy"));
    ASSERT_TRUE(array);
    const std::vector<float> row{4, 4, 4, 3, 1, 0, 0, 0};
    for (std::size_t k = 0; k < 48; ++k)
        EXPECT_EQ(array->values[k], static_cast<double>(row[k % 8])) << k;
}

TEST_F(RunTest, APictureThatCannotBeReadIsAnErrorAtItsPath) {
    ASSERT_TRUE(write_file(path("text.png"), "no picture"));
    Script script =
        load("stage s: turing_spots { a: image(\"none.png\"); b: image(\"text.png\") }\n");
    run_badly(script, request());
    const std::string messages = script.messages(false);
    EXPECT_THAT(messages, ::testing::HasSubstr("test.cascade:1:34: error: cannot read"));
    EXPECT_THAT(messages, ::testing::HasSubstr("text.png': it is not a PNG file"));
    EXPECT_EQ(script.diagnostics.error_count(), 2U);
    Script outside = load("stage s: turing_spots { a: image(\"/dev/zero\") }\n");
    run_badly(outside, request());
    EXPECT_EQ(outside.diagnostics.error_count(), 1U);
}

TEST_F(RunTest, AFieldOfAnotherShapeIsAnErrorAtItsPath) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.save = folder_;
    run_well(script, wanted);
    Script reader = load("stage s: turing_spots { b: field(\"small.b.npy\") }\n");
    run_badly(reader, request());
    EXPECT_EQ(
        reader.messages(false),
        "test.cascade:1:34: error: 'small.b.npy' has 18 rows and 24 columns, but the grid has "
        "64 and 64\n"
        "    1 | stage s: turing_spots { b: field(\"small.b.npy\") }\n"
        "      |                                  ^~~~~~~~~~~~~ a grid of 24, 18 would fit\n");
}

TEST_F(RunTest, FramesComeAtTheInterval) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.frames = path("frames");
    run_well(script, wanted);
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path("frames"))) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names,
              (std::vector<std::string>{"0000-large-0000000.png", "0001-large-0000100.png",
                                        "0002-large-0000200.png", "0003-large-0000300.png",
                                        "0004-small-0000050.png", "0005-small-0000100.png",
                                        "0006-small-0000150.png", "0007-small-0000200.png"}));
}

TEST_F(RunTest, AnOutputThatCannotBeWrittenIsFoundBeforeTheFirstStep) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    wanted.outputs = {path("no/such/folder/picture.png")};
    bool stepped = false;
    RunControl control;
    control.report = [&](const Progress& progress) { stepped = stepped || progress.step > 0; };
    EXPECT_FALSE(run(script, wanted, control));
    EXPECT_FALSE(stepped);
}

TEST_F(RunTest, CancelKeepsTheLastCompleteStep) {
    Script script = load(two_stages);
    RunRequest wanted = request();
    RunControl control;
    control.cancel = true;
    const auto report = run(script, wanted, control);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->status, RunStatus::cancelled);
    EXPECT_TRUE(std::filesystem::exists(wanted.outputs[0]));
}

TEST_F(RunTest, ThePictureBlockFallsBackWhereItsStageHasNotRun) {
    const std::string text = std::string(two_stages) +
                             "picture { color: if(small.b < 4, rgb(1, 0, 0), rgb(0, 1, 0)) }\n";
    Overrides first_only;
    first_only.until_stage = "large";
    Script script = load(text, first_only);
    run_well(script, request());
    ASSERT_FALSE(warnings_.empty());
    EXPECT_NE(warnings_.back().find("default picture"), std::string::npos);
}

TEST_F(RunTest, BlowingUpNamesStageSpeciesCellStepAndSpeed) {
    Script script = load(
        "domain { grid: 32, 32 }\n"
        "system heat { u: random(0, 1); d: 0.3; u' = d * lap(u) }\n"
        "stage warm: heat { iterations: 5000 }\n");
    const std::string words = run_badly(script, request());
    EXPECT_NE(words.find("stage 'warm' (heat): u is not finite any more at column "),
              std::string::npos)
        << words;
    // The chequerboard mode decays at 8 d: the limit is 2 / 2.4.
    EXPECT_NE(words.find("the largest stable speed is about 0.83"), std::string::npos) << words;
    EXPECT_FALSE(std::filesystem::exists(path("picture.png")));
}

TEST_F(RunTest, WarnsOfAChequerboard) {
    Script script = load(
        "domain { grid: 32, 32 }\n"
        "stage warm: turing_spots { iterations: 3000; diff_a: .25; diff_b: .0625; ka: 0.02 }\n");
    run_well(script, request());
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_NE(warnings_[0].find("chequerboard"), std::string::npos);
    EXPECT_NE(warnings_[0].find("largest stable speed"), std::string::npos);
}

TEST_F(RunTest, SpaceTimeStacksTheRowsOfAnInterval) {
    Script script = load(
        "domain { grid: 40 }\n"
        "stage s: turing_spots { iterations: 90; interval: 10 }\n");
    RunRequest wanted = request();
    wanted.picture.space_time = true;
    run_well(script, wanted);
    const auto png = bytes("picture.png");
    ASSERT_GT(png.size(), 24u);
    EXPECT_EQ(static_cast<unsigned char>(png[19]), 40);  // Width and height in the header.
    EXPECT_EQ(static_cast<unsigned char>(png[23]), 10);
}

TEST_F(RunTest, AGridLargerThanMemoryIsRefusedBeforeItIsMade) {
    Overrides overrides;
    overrides.grid = {40000, 40000};
    Script script = load("stage s: turing_spots { }\n", overrides);
    EXPECT_NE(run_badly(script, request()).find("GB"), std::string::npos);
}

#if CASCADE_HAS_JIT
TEST_F(RunTest, NativeCodeGivesTheBitsOfTheInterpreter) {
    for (const int threads : {1, 2, 5}) {
        Script interpreted = load(two_stages);
        RunRequest first = request();
        first.save = path("interpreted");
        run_well(interpreted, first);
        Script compiled = load(two_stages);
        RunRequest second = request();
        second.simulation.backend = "jit";
        second.simulation.threads = threads;
        second.save = path("compiled");
        run_well(compiled, second);
        for (const char* name : {"large.a.npy", "large.b.npy", "small.a.npy", "small.b.npy"}) {
            EXPECT_EQ(bytes(std::string("interpreted/") + name),
                      bytes(std::string("compiled/") + name));
        }
    }
}
#endif

TEST_F(RunTest, SidesOfDefinitionsReadFiles) {
    Field field{PlaneLayout(Grid{8, 6})};
    for (std::int64_t j = 0; j < 6; ++j) std::fill_n(field.row(j), 8, 0.25F);
    ASSERT_TRUE(write_npy(path("quarter.npy"), field));
    std::vector<std::string> grown;
    for (const char* value : {"field(\"quarter.npy\")", "0.25"}) {
        Script script = load(std::string("domain { grid: 8, 6; boundary: noflux }\n"
                                         "system s { c: x; m = c - lap(c); c' = lap(m) }\n"
                                         "stage only: s { iterations: 9; speed: 0.01; m.left: "
                                         "fixed(") +
                             value + ") }\n");
        RunRequest wanted = request();
        wanted.save = path("saved");
        run_well(script, wanted);
        grown.push_back(bytes("saved/only.c.npy"));
    }
    EXPECT_EQ(grown[0], grown[1]);
}

}  // namespace
}  // namespace cascade
