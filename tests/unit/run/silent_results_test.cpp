// Runs that end well and show nothing, or something else than one would think, say so in one line;
// and runs that are as they should be say nothing.
#include "run_fixture.h"

#include "run/commands/sweep.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr const char* gray_scott = R"(
system gs {{
  u: {}
  v: {}
  feed: {}; kill: {}
  u' = 0.16 * lap(u) - u * v^2 + feed * (1 - u)
  v' = 0.08 * lap(v) + u * v^2 - (feed + kill) * v
}}
domain {{ grid: 32, 32 }}
stage coral: gs {{ iterations: {} }}
)";

class SilentResults : public RunTest {
protected:
    /// What a run of `text` says, of its script and of its result.
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

TEST_F(SilentResults, NothingTellsOneCellFromAnother) {
    EXPECT_THAT(words_of(fmt::format(gray_scott, "1", "0", 0.037, 0.06, 200)),
                ElementsAre(
                    "stage 'coral' ended even (u = 1, v = 0): nothing tells one cell from another; "
                    "noise or a spot in a starting value would"));
    EXPECT_THAT(words_of("system s { u: 1; v: 0.9; u' = 0.1 - u + u^2*v + lap(u); v' = 0.9 - u^2*v "
                         "+ 40*lap(v) }\n"
                         "domain { grid: 16, 16 }\n"
                         "stage t: s { speed: 0.005; iterations: 100 }\n"),
                ElementsAre(HasSubstr("nothing tells one cell from another")));
}

TEST_F(SilentResults, NoiseThatFades) {
    EXPECT_THAT(words_of("system s { u: 1 + random(0, 0.01); v: 0.9\n"
                         "  u' = 0.1 - u + u^2*v + lap(u); v' = 0.9 - u^2*v + lap(v) }\n"
                         "domain { grid: 16, 16 }\n"
                         "stage t: s { speed: 0.1; iterations: 3000 }\n"),
                ElementsAre(
                    StartsWith("stage 't' ended even (u = 1, v = 0.9): the differences it began "
                               "with faded, and nothing has grown; it is even since step ")));
}

TEST_F(SilentResults, APatternThatDied) {
    const std::string text = fmt::format(gray_scott, "1 - 0.5*disc(0.5, 0.5, 0.2)",
                                         "0.25*disc(0.5, 0.5, 0.2)", 0.1, 0.1, 600);
    EXPECT_THAT(words_of(text),
                ElementsAre(StartsWith("stage 'coral' died out: it is even since step ")));
    Overrides fewer;
    fewer.steps = 80;
    EXPECT_THAT(words_of(text, request(), fewer),
                ElementsAre(
                    StartsWith("stage 'coral' is dying out: the deviations left are small and "
                               "falling (u ")));
}

TEST_F(SilentResults, APatternThatIsStillGrowing) {
    for (const std::int64_t steps : {100, 600}) {
        Overrides few;
        few.steps = steps;
        EXPECT_THAT(
            words_of("stage s: turing_spots { iterations: 8000; ka: 1/80 }\n", request(), few),
            ElementsAre(
                AllOf(StartsWith("stage 's' was still growing when it ended: the deviation "),
                      HasSubstr(" % in the last tenth, to 0."))))
            << steps;
    }
}

TEST_F(SilentResults, AnUntilThatNeverCameTrue) {
    static constexpr const char* settles =
        "domain {{ grid: 24, 24 }}\nstage s: turing_spots {{ until: {}; iterations: {} }}\n";
    EXPECT_THAT(words_of(fmt::format(settles, "steady(0.2)", 400)),
                ElementsAre(
                    "stage 's' took 400 steps and has not settled as 'until: steady(0.2)' asks"));
    EXPECT_THAT(words_of(fmt::format(settles, "max(b over domain) > 100", 400)),
                ElementsAre("stage 's' took 400 steps and 'until' has not ended it"));
    EXPECT_THAT(words_of(fmt::format(settles, "max(b over domain) > 4.1", 8000)), IsEmpty());
}

TEST_F(SilentResults, AllOfThePictureBesideTheRange) {
    const std::string text =
        "domain { grid: 24, 24 }\nstage s: turing_spots { iterations: 4000 }\n";
    RunRequest wanted = request();
    EXPECT_THAT(words_of(text, wanted), IsEmpty());
    wanted.picture.range = ValueRange{50, 90};
    EXPECT_THAT(words_of(text, wanted),
                ElementsAre(AllOf(StartsWith("the picture is of one colour: all it shows ("),
                                  HasSubstr("lies below the range 50,90"))));
    wanted.picture.range = ValueRange{-1, -2};
    EXPECT_THAT(words_of(text, wanted), ElementsAre(HasSubstr("lies above the range -1,-2")));
    wanted.picture.range = ValueRange{-10000, 10000};
    EXPECT_THAT(words_of(text, wanted), ElementsAre(HasSubstr("is one level of the range")));
    wanted.picture.range = ValueRange{3, 5};
    EXPECT_THAT(words_of(text, wanted), IsEmpty());
    wanted.picture.range.reset();
    wanted.picture.show = "ka";
    EXPECT_THAT(words_of(text, wanted),
                ElementsAre("the picture is of one colour: what it shows is 0.0125 in all cells"));
}

TEST_F(SilentResults, WavesOfFewCells) {
    EXPECT_THAT(
        words_of("domain { grid: 32, 32 }\n"
                 "stage s: turing_spots { iterations: 6000; diff_a: 1/80; diff_b: 1/320 }\n"),
        ElementsAre(AllOf(StartsWith("the waves of the pattern are 2."), HasSubstr("cells long"))));
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
    // Another line in place of one.
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
                HasSubstr("<--seed>:1:1: warning: nothing in this script is random, so no seed "
                          "changes its result"));
    for (const char* random :
         {"stage a: s { k: random(0.1, 0.01) }\n",
          "stage a: s { }\ndomain { mask: noise(0.1) > 0 }\n",
          "stage a: s { u.left: fixed(random(0, 1)) }\ndomain { boundary: noflux }\n",
          "domain { surface: sphere; cells: 500 }\nstage a: s { }\n"}) {
        EXPECT_EQ(messages(system + random), "") << random;
    }
}

TEST_F(SilentResults, AStageThatNobodyReads) {
    const std::string first =
        "domain { grid: 24, 24 }\nstage one: turing_spots { iterations: 300 }\n";
    static constexpr const char* second = "stage two: turing_spots {{ iterations: 4000; {} }}\n";
    EXPECT_THAT(words_of(first + fmt::format(second, "")),
                ElementsAre("no later stage and no picture reads stage 'one' | "
                            "'a: a; b: b' in stage 'two' goes on from it"));
    // What the hint says helps.
    EXPECT_THAT(words_of(first + fmt::format(second, "a: a; b: b")), IsEmpty());
    EXPECT_THAT(words_of(first + fmt::format(second, "frozen: one.b < 4")), IsEmpty());
    EXPECT_THAT(words_of(first + fmt::format(second, "") +
                         "picture { color: rgb(one.b/8, b/8, 0) }\n"),
                IsEmpty());
    const std::string other =
        "system s { u: random(0, 1); u' = 0.01*(0.5 - u)*(u - 1)*u }\n"
        "stage two: s { iterations: 4 }\n";
    EXPECT_THAT(words_of(first + other),
                ElementsAre(
                    "no later stage and no picture reads stage 'one' | a stage begins with its own "
                    "starting values: 'p: one.a' would read this one"));
}

/// Dying fields in a sweep: the numbers are those of a ripple, and the remark says what it is.
TEST_F(SilentResults, SweepsRemarkOnTheirRuns) {
    const Script script = load(
        "system s { u: 3.7 + random(0, 0.5); c: -0.02; u' = c*(u - 3.7) + 0.02*lap(u) }\n"
        "domain { grid: 24, 24 }\nstage skin: s { iterations: 200 }\n");
    SweepRequest wanted;
    wanted.varied.push_back(*parse_variation("s.c=-0.03,-0.1,0.0005"));
    wanted.folder = path("sweep");
    wanted.simulation.backend = BackendKind::interpreter;
    SweepControl control;
    ASSERT_TRUE(sweep(script, wanted, control));
    std::ifstream table(path("sweep/features.csv"));
    std::vector<std::string> rows;
    for (std::string row; std::getline(table, row);) rows.push_back(row);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_THAT(rows[1],
                HasSubstr(
                    "stage 'skin' is dying out: the deviations left are small and falling (u "));
    EXPECT_THAT(rows[2], HasSubstr("stage 'skin' died out: it is even since step "));
    EXPECT_THAT(rows[3], testing::EndsWith(",200,"));
}

TEST_F(SilentResults, ARunThatStopsOnTheWaySaysNothing) {
    RunRequest wanted = request();
    wanted.stop_at = StopAt{"coral", 100};
    EXPECT_THAT(words_of(fmt::format(gray_scott, "1", "0", 0.037, 0.06, 200), wanted), IsEmpty());
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
                ElementsAre("the saved run had come to its end, and no step was left to take: "
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
    EXPECT_THAT(warnings_, testing::Contains(
                               "stage 'large' stays at step 100: stage 'small' has begun from it"));
}

struct Told {
    const char* name;
    const char* script;  ///< After a domain of 48 × 48 cells.
    const char* words;   ///< Part of the one thing that is said.
};

constexpr Told told[] = {
    {"growth that anti-diffusion does not bring",
     "system s { u: random(0, 0.1); u' = -0.01 * lap(u) - u; u >= 0-1; u <= 1 }\n"
     "stage a: s { iterations: 500; speed: 0.5 }",
     "died out"},
    {"all that is shown is infinite",
     "system s { u: sx + 1; u' = 0.1 * lap(u) }\n"
     "stage a: s { iterations: 50; show: exp(1000 * u) }",
     "infinite or not a number in all cells"},
    {"none of what is shown is a number",
     "system s { u: sx; u' = 0.1 * lap(u) }\n"
     "stage a: s { iterations: 50; show: log(u - 5) }",
     "infinite or not a number in all cells"},
    {"a front that has passed",
     "system s { u: disc(0.5, 0.5, 0.1); u' = 0.2 * lap(u) + u * (1 - u) }\n"
     "stage a: s { iterations: 3000; speed: 0.5 }",
     "(u = 1)"},
    {"values at their bound",
     "system s { u: random(0.5, 0.4); u' = u; u <= 1; u >= 0 }\n"
     "stage a: s { iterations: 500; speed: 0.5 }",
     "(u = 1)"},
    {"a pulse between two fixed steps",
     "system s { u: 0; u' = exp(-((t - 50.5) / 0.05)^2) * 20 }\n"
     "stage a: s { iterations: 100 }",
     "ended even"},
    {"a mixture without noise", "stage a: cahn_hilliard { c: 0.5; iterations: 500; speed: 0.02 }",
     "ended even"},
    {"a stage that is frozen everywhere", "stage a: turing_spots { iterations: 1000; frozen: 1 }",
     "is frozen in all cells: nothing in it changes"},
    {"a condition beyond reach",
     "stage a: turing_spots { until: max(b over domain) > 100; iterations: 3000; ka: 0.05 }",
     "'until' has not ended it"},
    {"an 'until' that is never looked at",
     "stage a: turing_spots { until: max(b over domain) > 5; check: 5000; iterations: 3000; ka: "
     "0.05 }",
     "never looked at 'until', which it does every 5,000 steps"},
    {"steps of no length", "stage a: turing_spots { iterations: 300; speed: 1e-30 }",
     "ended even (a = 4, b = 4): nothing has grown"},
    {"the wrong sign of diffusion",
     "system s { u: random(0.5, 0.1); d: -0.02; u' = d*lap(u) + u*(1 - u)*(u - 0.5); u >= 0; u <= "
     "1 }\n"
     "stage a: s { iterations: 3000 }",
     "% of the pattern is waves of fewer than 4 cells"},
    {"aggregation into single cells",
     "system s { n: random(1, 0.1); c: 1; n' = lap(n) - div(20*n*grad(c)); c' = lap(c) + n - c; n "
     ">= 0; n <= 20 }\n"
     "stage a: s { speed: 0.05; iterations: 2000 }",
     "% of the pattern is waves of fewer than 4 cells"},
    {"colours beyond white",
     "stage a: turing_spots { iterations: 3000; ka: 0.05 }\n"
     "picture { color: rgb(100 + b, 100 + b, 128) }",
     "red, green and blue lies beyond 0 … 1"},
    {"a palette whose range is beside the values",
     "stage a: turing_spots { iterations: 3000; ka: 0.05 }\n"
     "picture { color: palette(b, 50, 90, \"tan\") }",
     "the picture is of one colour"},
    {"a picture that reads nothing",
     "stage a: turing_spots { iterations: 3000; ka: 0.05 }\n"
     "picture { color: rgb(0.5, 0.2, 0.1) }",
     "the picture is of one colour"},
    {"what is shown is a constant", "stage a: turing_spots { iterations: 3000; ka: 0.05; show: 3 }",
     "what it shows is 3 in all cells"},
    {"a spot beside the domain",
     "system s { u: disc(32, 32, 5); u' = 0.1*lap(u) }\nstage a: s { iterations: 100 }",
     "nothing tells one cell"},
    {"a lattice without a seed in the domain",
     "system s { u: lattice(3, 0.01); u' = 0.1*lap(u) }\nstage a: s { iterations: 100 }",
     "nothing tells one cell"},
    {"a threshold that no draw reaches",
     "system s { u: random(0, 1/2) > 0.5; u' = 0.1*lap(u) }\nstage a: s { iterations: 100 }",
     "nothing tells one cell"},
    {"bounds above each other",
     "system s { u: random(0.5, 0.5); u' = 0.1*lap(u); u >= 1; u <= 0 }\nstage a: s { iterations: "
     "100 }",
     "(u = 0)"},
    {"starting values beyond a bound",
     "system s { u: random(5, 1); u' = 0.1*lap(u); u <= 1 }\nstage a: s { iterations: 100 }",
     "(u = 1)"},
    {"a stage that goes on from another chemistry",
     "stage one: turing_spots { iterations: 3000; ka: 0.05 }\n"
     "stage two: gray_scott { u: one.a/8; v: 0; iterations: 1000 }",
     "stage 'two' died out"},
    {"a threshold that freezes all",
     "stage one: turing_spots { iterations: 3000; ka: 0.05 }\n"
     "stage two: turing_spots { iterations: 1000; frozen: one.b > -5; a: a; b: b; ka: 0.05 }",
     "stage 'two' is frozen in all cells"},
    {"a threshold that freezes nothing",
     "stage one: turing_spots { iterations: 3000; ka: 0.05 }\n"
     "stage two: turing_spots { iterations: 1000; frozen: one.b < -5; a: a; b: b; ka: 0.05 }",
     "stage 'two' is frozen in no cell"},
    {"differences that are errors of steps",
     "system s { u: random(0.5, 0.1); u' = -200*(u - 0.5) + 0.1*lap(u) }\n"
     "stage a: s { solver: rk45; duration: 50 }",
     "ended all but even"},
    {"noise that has just begun to grow",
     "system s { u: random(0, 0.001); u' = 0.2 * lap(u) + 0.02 * u - u^3 }\n"
     "stage a: s { iterations: 150 }",
     "still growing"},
};

TEST_F(SilentResults, AStageThatEndsAsItBegan) {
    const std::string rates =
        "system s { u: 0.5 + random(0, 0.3); u' = 0.1*dyy(u) + 0.05*dxy(u) - dy(u) }\n";
    EXPECT_THAT(words_of(rates + "domain { grid: 100 }\nstage a: s { iterations: 300 }\n"),
                ElementsAre("stage 'a' ended as it began: its rates are 0 in all cells; on a line "
                            "derivatives along "
                            "y are 0"));
    EXPECT_THAT(words_of(rates +
                         "domain { grid: 100, 3 }\nstage a: s { speed: 0.1; iterations: 300 }\n"),
                IsEmpty());
    EXPECT_THAT(words_of("system s { u: x; k: 0; u' = k*lap(u) }\ndomain { grid: 8, 8 }\n"
                         "stage a: s { iterations: 30 }\n"),
                ElementsAre("stage 'a' ended as it began: its rates are 0 in all cells"));
}

/// Noise that the stage has not made is meant, or has not been smoothed yet.
TEST_F(SilentResults, NoiseThatIsMeant) {
    for (const char* script :
         {"system s { u: noise(0.001); u' = 0.01*lap(u) }\nstage a: s { iterations: 10 }\n",
          "system s { u: random(0.5, 0.1); u' = u*(1 - u)*(u - 0.5) }\nstage a: s { iterations: "
          "300 }\n",
          "system s { u: 0; u' = 0.01*lap(u) - 0.5*u + normal(0, 1) }\nstage a: s { iterations: "
          "300 }\n",
          "system s { k: random(0, 1); u: 0; u' = 0.01*lap(u) + 0.1*(k - u) }\nstage a: s { "
          "iterations: 300 }\n"}) {
        EXPECT_THAT(words_of(std::string("domain { grid: 48, 48 }\n") + script), IsEmpty())
            << script;
    }
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

TEST_F(SilentResults, OneTrueLineEach) {
    for (const Told& each : told) {
        EXPECT_THAT(words_of(std::string("domain { grid: 48, 48 }\n") + each.script),
                    ElementsAre(HasSubstr(each.words)))
            << each.name;
    }
}

}  // namespace
}  // namespace cascade
