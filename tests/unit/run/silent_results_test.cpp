// Runs that succeed but show nothing, or something misleading, print a line that says so. Other
// runs print nothing. The remarks that are tested here depend on the request. Remarks that depend
// on the script alone are tested in tests/scripts/remarks.
#include "run_fixture.h"

#include "run/commands/sweep.h"

#include <gmock/gmock.h>

#include <fstream>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class SilentResults : public RunTest {
protected:
    /// The remarks of a run of `text` about its script and about its result.
    std::vector<std::string> words_of(const std::string& text) { return words_of(text, request()); }
    std::vector<std::string> words_of(const std::string& text, const RunRequest& request,
                                      const Overrides& changes = {}) {
        Script script = load(text, changes);
        EXPECT_TRUE(script.program) << script.messages(false);
        warnings_.clear();
        const RunReport report = run_well(script, request);
        EXPECT_EQ(report.remarks, warnings_);
        std::vector<std::string> words = warnings_;
        for (const Diagnostic& each : script.diagnostics.sorted()) {
            words.push_back(each.message + " | " + each.hint);
        }
        return words;
    }
};

TEST_F(SilentResults, AllOfThePictureBesideTheRange) {
    const std::string text =
        "domain { grid: 24, 24 }\nstage s: turing_spots { iterations: 4000 }\n";
    RunRequest wanted = request();
    EXPECT_THAT(words_of(text, wanted), IsEmpty());
    wanted.picture.range = ValueRange{50, 90};
    EXPECT_THAT(words_of(text, wanted),
                ElementsAre(AllOf(StartsWith("the picture is of one colour: all shown values ("),
                                  HasSubstr("lie below the range 50,90"))));
    wanted.picture.range = ValueRange{-1, -2};
    EXPECT_THAT(words_of(text, wanted), ElementsAre(HasSubstr("lie above the range -1,-2")));
    wanted.picture.range = ValueRange{-10000, 10000};
    EXPECT_THAT(words_of(text, wanted),
                ElementsAre(HasSubstr("lie within one level of the range")));
    wanted.picture.range = ValueRange{3, 5};
    EXPECT_THAT(words_of(text, wanted), IsEmpty());
    wanted.picture.range.reset();
    wanted.picture.show = "ka";
    EXPECT_THAT(words_of(text, wanted),
                ElementsAre(
                    "the picture is of one colour: the shown value is 0.0125 in all cells"));
}

TEST_F(SilentResults, AGridThatIsALine) {
    Overrides line;
    line.grid = GridSize{100, 1};
    const std::string text = "stage s: turing_spots { iterations: 3000 }\n";
    EXPECT_THAT(words_of(text, request(), line), IsEmpty());
    line.grid_is_one_number = true;
    EXPECT_THAT(words_of(text, request(), line),
                ElementsAre("this is a line of 100 cells | for a square write --grid 100x100"));
    EXPECT_THAT(load(text, line).messages(false), HasSubstr("\n    1 | 100\n"));
    // A line of the command line replaces a statement of the script.
    EXPECT_THAT(words_of("domain { grid: 60 }\n" + text, request(), line), IsEmpty());
}

TEST_F(SilentResults, ASeedOfNothingRandom) {
    Overrides seeded;
    seeded.seed = 5;
    const auto messages = [&](const std::string& text) {
        return load(text, seeded).messages(false);
    };
    const std::string system = "system s { k: 0.1; u: disc(0.5, 0.5, 0.2); u' = k*lap(u) }\n";
    EXPECT_THAT(messages(system + "stage a: s { }\n"),
                HasSubstr("<--seed>:1:1: warning: the seed has no effect, because nothing in "
                          "this script is random"));
    for (const char* random :
         {"stage a: s { k: random(0.1, 0.01) }\n",
          "stage a: s { }\ndomain { mask: noise(0.1) > 0 }\n",
          "stage a: s { u.left: fixed(random(0, 1)) }\ndomain { boundary: noflux }\n",
          "domain { surface: sphere; cells: 500 }\nstage a: s { }\n"}) {
        EXPECT_EQ(messages(system + random), "") << random;
    }
}

/// A sweep over fields that die out. Their features are those of a faint ripple, and a remark says
/// so.
TEST_F(SilentResults, SweepsRemarkOnTheirRuns) {
    const Script script = load(
        "system s { u: 3.7 + random(0, 0.5); c: -0.02; u' = c*(u - 3.7) + 0.02*lap(u) }\n"
        "domain { grid: 24, 24 }\nstage skin: s { iterations: 200 }\n");
    SweepRequest wanted;
    wanted.varied.push_back(*parse_variation("s.c=-0.03,-0.1,0.0005"));
    wanted.folder = path("sweep");
    wanted.simulation.backend = "interp";
    SweepControl control;
    ASSERT_TRUE(sweep(script, wanted, control));
    std::ifstream table(path("sweep/features.csv"));
    std::vector<std::string> rows;
    for (std::string row; std::getline(table, row);) rows.push_back(row);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_THAT(rows[1],
                HasSubstr(
                    "stage 'skin' is dying out: the remaining differences between its cells are "
                    "small and shrinking (u "));
    EXPECT_THAT(rows[2], HasSubstr("stage 'skin' died out: it has been uniform since step "));
    EXPECT_THAT(rows[3], testing::EndsWith(",200,"));
}

TEST_F(SilentResults, ARunThatStopsOnTheWaySaysNothing) {
    RunRequest wanted = request();
    wanted.stop_at = StopAt{"coral", 100};
    EXPECT_THAT(words_of("stage coral: gray_scott { u: 1; v: 0; iterations: 200 }\n", wanted),
                IsEmpty());
}

TEST_F(SilentResults, AResumedRunGoesOnOrSaysWhyNot) {
    const std::string text =
        "domain { grid: 24, 24 }\nstage s: turing_spots { iterations: 4000; ka: 1/40 }\n";
    Overrides changes;
    changes.steps = 1000;
    RunRequest wanted = request();
    wanted.save = path("half");
    words_of(text, wanted, changes);
    wanted.save = path("straight");
    changes.steps = 3000;
    words_of(text, wanted, changes);

    RunRequest on = request();
    on.resume = path("half");
    on.save = path("resumed");
    auto saved = load_saved_script(path("half"), changes);
    ASSERT_TRUE(saved);
    EXPECT_EQ(run_well(*saved, on).steps, 2000);
    EXPECT_EQ(array("resumed/s.b.npy"), array("straight/s.b.npy"));

    on.resume = path("resumed");
    saved = load_saved_script(path("resumed"), changes);
    ASSERT_TRUE(saved);
    warnings_.clear();
    EXPECT_EQ(run_well(*saved, on).steps, 0);
    EXPECT_THAT(warnings_,
                ElementsAre("the saved run was complete already, so no steps were taken: "
                            "stage 's', step 3000 of 3000"));
}

TEST_F(SilentResults, WhatALaterStageBeganFromStays) {
    Overrides changes;
    changes.steps = 100;
    RunRequest wanted = request();
    wanted.save = path("half");
    words_of(two_stages, wanted, changes);
    changes.steps = 150;
    auto saved = load_saved_script(path("half"), changes);
    ASSERT_TRUE(saved);
    RunRequest on = request();
    on.resume = path("half");
    warnings_.clear();
    EXPECT_EQ(run_well(*saved, on).steps, 50);
    EXPECT_THAT(warnings_,
                testing::Contains("stage 'large' stays at step 100, because stage 'small' has "
                                  "already begun from it"));
}

TEST_F(SilentResults, APaletteForAPictureOfColours) {
    const std::string text =
        "domain { grid: 24, 24 }\nstage s: turing_spots { iterations: 4000 }\n"
        "picture { color: rgb(b/8, 0.1, 0.2) }\n";
    RunRequest wanted = request();
    EXPECT_THAT(words_of(text, wanted), IsEmpty());
    wanted.picture.palette = "viridis";
    EXPECT_THAT(words_of(text, wanted),
                ElementsAre("--palette changes nothing: the script's picture is made of "
                            "colours; --show draws a number instead"));
    wanted.picture.range = ValueRange{0, 8};
    EXPECT_THAT(words_of(text, wanted),
                ElementsAre(StartsWith("--palette and --range change nothing")));
    wanted.picture.show = "b";
    EXPECT_THAT(words_of(text, wanted), IsEmpty());
}

TEST_F(SilentResults, AMaterialOfABody) {
    const std::string text =
        "domain { grid: 8, 8, 8 }\nstage s: turing_spots { iterations: 40 }\n"
        "picture { color: rgb(b/8, 0.1, 0.2); body: b - 4";
    const auto remark =
        testing::Contains(StartsWith("the picture does not show 'roughness' and 'height'"));
    EXPECT_THAT(words_of(text + "; roughness: 0.1; height: b }\n"), remark);
    EXPECT_THAT(words_of(text + " }\n"), testing::Not(remark));
}

TEST_F(SilentResults, FramesOfStartsAlone) {
    const std::string text =
        "domain { grid: 24, 24 }\nstage s: turing_spots { iterations: 4000; interval: ";
    RunRequest wanted = request();
    wanted.frames = path("film");
    EXPECT_THAT(
        words_of(text + "10000 }\n", wanted),
        ElementsAre(
            "the frames show nothing but starting values: 'interval' is longer than each stage"));
    EXPECT_THAT(words_of(text + "4000 }\n", wanted), IsEmpty());
}

TEST_F(SilentResults, PicturesAndMasksOfOneLevel) {
    Image grey;
    grey.width = grey.height = 5;
    grey.pixels.assign(25, Colour{1.0F / 255, 1.0F / 255, 1.0F / 255});
    ASSERT_TRUE(write_png(path("dark.png"), grey, PngDepth::eight, {}));
    const std::string run = "stage s: turing_spots { iterations: 3000; ka: 0.05 }\n";
    const auto warnings_of = [&](const std::string& mask) {
        warnings_.clear();
        Script script = load("domain { grid: 24, 24; mask: " + mask + " }\n" + run);
        run_well(script, request());
        return warnings_;
    };
    EXPECT_THAT(warnings_of("image(\"dark.png\")"),
                ElementsAre("image(\"dark.png\") is 0.003922 in all cells",
                            "the mask of the domain leaves no cell out: it is nowhere 0"));
    EXPECT_THAT(warnings_of("disc(0.5, 0.5, 0.4)"), IsEmpty());
}

}  // namespace
}  // namespace cascade
