// `--detail` in runs: what pictures show, what is saved, and what is refused.
#include "resumed_run.h"

#include <utility>

namespace cascade {
namespace {

constexpr const char* two_sizes_of_spots =
    "domain { grid: 24, 18; seed: 5 }\n"
    "stage large: turing_spots { iterations: 300; interval: 100; ka: 1/80 }\n"
    "stage small: turing_spots { iterations: 200; frozen: b < 4; a: a; b: b; "
    "beta: beta; ka: 1/30 }\n";

class DetailedRunTest : public ResumedRunTest {
protected:
    RunRequest detailed(const std::string& picture, int detail = 2) const {
        RunRequest wanted = request();
        wanted.picture.detail = detail;
        wanted.outputs = {path(picture)};
        return wanted;
    }

    /// The width and height in pixels, from the header of a PNG.
    std::pair<int, int> size_of(const std::string& picture) const {
        const std::string png = bytes(picture);
        if (png.size() < 24) return {0, 0};
        const auto number = [&](std::size_t at) {
            int result = 0;
            for (std::size_t k = at; k < at + 4; ++k)
                result = 256 * result + static_cast<unsigned char>(png[k]);
            return result;
        };
        return {number(16), number(20)};
    }

    /// The diagnostics of a run that is refused.
    std::string refused(const std::string& text, const RunRequest& wanted) {
        Script script = load(text);
        run_badly(script, wanted);
        return script.messages(false);
    }
};

TEST_F(DetailedRunTest, PicturesShowTheFinerCells) {
    Script script = load(two_sizes_of_spots);
    const RunReport report = run_well(script, detailed("fine.png", 3));
    EXPECT_EQ(size_of("fine.png"), std::pair(72, 54));
    EXPECT_EQ(report.status, RunStatus::finished);
    EXPECT_GT(report.steps, 500);
}

TEST_F(DetailedRunTest, PicturesRememberIt) {
    Script script = load(two_sizes_of_spots);
    run_well(script, detailed("fine.png"));
    auto file = load_script_file(path("fine.png"));
    ASSERT_TRUE(file);
    RunRequest again = request();
    again.outputs = {path("again.png")};
    const auto stored = picture_request_from_json(file->picture_options);
    ASSERT_TRUE(stored);
    again.picture = *stored;
    EXPECT_EQ(again.picture.detail, 2);
    run_well(file->script, again);
    EXPECT_EQ(bytes("again.png"), bytes("fine.png"));
}

TEST_F(DetailedRunTest, TheRunItselfIsThatOfTheScriptsCells) {
    run_whole(two_sizes_of_spots);
    Script script = load(two_sizes_of_spots);
    RunRequest wanted = detailed("fine.png");
    wanted.save = path("saved");
    wanted.log.expressions = {"mean(b over domain)"};
    run_well(script, wanted);
    for (const std::string array : {"large.b", "small.a", "small.b", "small.frozen"})
        EXPECT_EQ(bytes("saved/" + array + ".npy"), bytes("whole/" + array + ".npy")) << array;
    // Resumed from the saved run, which has no step left, the finer run gives the same picture.
    auto saved = load_saved_script(path("saved"), {});
    ASSERT_TRUE(saved);
    RunRequest later = detailed("later.png");
    later.resume = path("saved");
    run_well(*saved, later);
    EXPECT_EQ(bytes("later.png"), bytes("fine.png"));
}

TEST_F(DetailedRunTest, ResumesToTheSamePicture) {
    Script script = load(two_sizes_of_spots);
    run_well(script, detailed("whole.png"));
    Script part = load(two_sizes_of_spots);
    RunRequest first = detailed("part.png");
    first.save = path("part");
    first.stop_at = StopAt{"small", 70};
    run_well(part, first);
    EXPECT_EQ(size_of("part.png"), std::pair(24, 18));  // A stopped run is drawn in its own cells.
    auto rest = load_saved_script(path("part"), {});
    ASSERT_TRUE(rest);
    RunRequest second = detailed("rest.png");
    second.resume = path("part");
    run_well(*rest, second);
    EXPECT_EQ(bytes("rest.png"), bytes("whole.png"));
}

TEST_F(DetailedRunTest, ArraysOfTheScriptsGridAreCarried) {
    Script first = load(two_sizes_of_spots);
    RunRequest wanted = request();
    wanted.save = path("saved");
    run_well(first, wanted);
    Script script = load(
        "domain { grid: 24, 18 }\n"
        "stage one: turing_spots { iterations: 5; b: field(\"saved/small.b.npy\") }");
    run_well(script, detailed("fine.png"));
    EXPECT_EQ(size_of("fine.png"), std::pair(48, 36));
}

TEST_F(DetailedRunTest, FeaturesAreInLengthsOfTheDomain) {
    const auto features = [&](int detail) {
        Script script = load(
            "domain { grid: 64, 64; spacing: 0.5 }\nsystem s {\n"
            "  u: cos(6 * pi * sx)\n  u' = 0.001 * lap(u)\n}\n"
            "stage one: s { iterations: 10 }");
        RunRequest wanted = detailed("a.png", detail);
        wanted.features = true;
        return run_well(script, wanted).features;
    };
    const auto own = features(1), finer = features(2);
    ASSERT_TRUE(own && finer);
    EXPECT_NEAR(finer->wavelength, own->wavelength, 0.02 * own->wavelength);
    EXPECT_NEAR(finer->deviation, own->deviation, 0.01 * own->deviation);
}

TEST_F(DetailedRunTest, WhatHasNoFinerCellsIsRefused) {
    const auto expect = [&](const std::string& text, const RunRequest& wanted,
                            const std::string& message) {
        EXPECT_NE(refused(text, wanted).find(message), std::string::npos) << refused(text, wanted);
    };
    expect("domain { surface: sphere; cells: faces }\nstage one: turing_spots { iterations: 1 }",
           detailed("a.png"), "faces or points of a model cannot be divided");
    expect("domain { surface: sphere }\nstage one: scales { founders: 4; duration: 1 }",
           detailed("a.png"), "cells that crawl cannot be divided into finer cells");
    expect(
        "domain { grid: 8, 8; mask: random(0, 1) > 0 }\nstage one: turing_spots { iterations: 1 }",
        detailed("a.png"),
        "--detail cannot keep this mask, which draws a random number in each "
        "cell");
    expect("domain { grid: 16384, 16384 }\nstage one: turing_spots { iterations: 1 }",
           detailed("a.png", 8), "the domain would have 17179869184 cells");
    RunRequest film = detailed("film.gif");
    expect(two_sizes_of_spots, film, "--detail computes finer cells only at the end");
    RunRequest frames = detailed("a.png");
    frames.frames = path("frames");
    expect(two_sizes_of_spots, frames, "--detail computes finer cells only at the end");
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
    EXPECT_FALSE(std::filesystem::exists(path("frames")));
}

TEST_F(DetailedRunTest, ItsMemoryIsCountedBeforeTheFirstStep) {
    Script script = load(two_sizes_of_spots);
    RunRequest wanted = detailed("a.png", 8);
    wanted.simulation.memory_limit = 400'000;
    EXPECT_NE(run_badly(script, wanted).find("needs"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST_F(DetailedRunTest, ACancelledSettlingIsShownSoFar) {
    Script script = load(two_sizes_of_spots);
    RunControl control;
    control.report = [&](const Progress& progress) {
        if (progress.note.find("finer cells") != std::string::npos) control.cancel = true;
    };
    RunRequest wanted = detailed("a.png", 4);
    const auto report = run(script, wanted, control);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->status, RunStatus::cancelled);
    EXPECT_NE(report->where.find("settling in finer cells"), std::string::npos);
    EXPECT_EQ(size_of("a.png"), std::pair(96, 72));
}

}  // namespace
}  // namespace cascade
