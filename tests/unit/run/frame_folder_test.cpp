// A folder of frames holds the frames of one run.
#include "run_fixture.h"

#include "picture/grey_picture.h"
#include "run/pictures/frame_folder.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* filmed_spots =
    "domain { grid: 8, 8 }\nstage s: turing_spots { iterations: 40; interval: 20 }\n";

class FrameFolder : public RunTest {
protected:
    RunRequest frames_in(const std::string& folder) const {
        RunRequest wanted = request();
        wanted.frames = path(folder);
        return wanted;
    }
    std::vector<std::string> names(const std::string& folder) const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path(folder))) {
            names.push_back(entry.path().filename().string());
        }
        std::sort(names.begin(), names.end());
        return names;
    }
};

TEST_F(FrameFolder, HasNoFramesOfTheRunBefore) {
    Script script = load(filmed_spots);
    run_well(script, frames_in("film"));
    ASSERT_TRUE(write_file(path("film/notes.txt"), "mine"));
    ASSERT_TRUE(write_file(path("film/0001-b.png"), "mine"));
    Overrides changes;
    changes.sets = {"s.interval=30"};
    Script changed = load(filmed_spots, changes);
    run_well(changed, frames_in("film"));
    EXPECT_THAT(names("film"),
                ElementsAre("0000-s-0000000.png", "0001-b.png", "0001-s-0000030.png", "notes.txt"));
}

TEST_F(FrameFolder, OfAnotherScriptIsLeftAlone) {
    Script script = load(filmed_spots);
    run_well(script, frames_in("film"));
    Script other = load_script("other.cascade", filmed_spots, folder_);
    EXPECT_THAT(run_badly(other, frames_in("film")),
                HasSubstr(
                    "holds frames that other.cascade did not draw, such as 0000-s-0000000.png"));
    EXPECT_THAT(names("film"), testing::SizeIs(3));
    // A picture that the program did not write is not removed either.
    std::filesystem::create_directories(path("mine"));
    ASSERT_TRUE(write_file(path("mine/0000-holiday-0000001.png"), "sun"));
    EXPECT_THAT(run_badly(script, frames_in("mine")), HasSubstr("as 0000-holiday-0000001.png"));
    EXPECT_EQ(bytes("mine/0000-holiday-0000001.png"), "sun");
}

TEST_F(FrameFolder, HoldsThePixelsOfPictures) {
    Script script =
        load("domain { grid: 40, 30 }\nstage s: turing_spots { iterations: 60; interval: 10 }\n");
    RunRequest wanted = frames_in("film");
    wanted.picture.scale = 2;
    wanted.picture.range = ValueRange{3, 5};
    for (const int threads : {1, 3}) {
        wanted.simulation.threads = threads;
        for (const std::int64_t step : {0, 30, 60}) {
            wanted.stop_at = StopAt{"s", step};
            wanted.outputs = {path("stopped.png")};
            run_well(script, wanted);
            const auto frame = read_grey_picture(
                path("film/" + frame_name(static_cast<std::size_t>(step / 10), "s", step)));
            const auto picture = read_grey_picture(path("stopped.png"));
            ASSERT_TRUE(frame && picture);
            EXPECT_EQ(frame->width, 80);
            EXPECT_EQ(frame->values, picture->values);
        }
    }
}

/// There are as many threads as frames, so that later frames are ready when an earlier one fails.
TEST_F(FrameFolder, HoldsTheFramesBeforeOneThatCannotBeWritten) {
    Script script =
        load("domain { grid: 16, 16 }\nstage s: turing_spots { iterations: 50; interval: 10 }\n");
    RunRequest wanted = frames_in("film");
    wanted.simulation.threads = 6;
    RunControl control;
    control.report = [&](const Progress&) {
        std::filesystem::create_directories(path("film/0002-s-0000020.png"));
    };
    const auto report = run(script, wanted, control);
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message, HasSubstr("0002-s-0000020.png': Is a directory"));
    EXPECT_THAT(names("film"),
                ElementsAre("0000-s-0000000.png", "0001-s-0000010.png", "0002-s-0000020.png"));
}

TEST_F(FrameFolder, KeepsWhatItHasWhereARunFails) {
    Script script = load(filmed_spots);
    run_well(script, frames_in("film"));
    Script bad =
        load("system g { u: 1; u' = u^3 }\ndomain { grid: 4, 4 }\nstage s: g { iterations: 99 }\n");
    run_badly(bad, frames_in("film"));
    EXPECT_THAT(names("film"), testing::SizeIs(3));
}

TEST_F(FrameFolder, IsNotThatOfARunThatGoesOn) {
    Script script = load(filmed_spots);
    RunRequest wanted = frames_in("film");
    wanted.save = path("saved");
    wanted.stop_at = StopAt{"s", 20};
    run_well(script, wanted);
    auto saved = load_saved_script(path("saved"), {});
    ASSERT_TRUE(saved);
    RunRequest on = frames_in("film");
    on.resume = path("saved");
    EXPECT_THAT(run_badly(*saved, on), HasSubstr("holds frames of an earlier run"));
    on.frames = path("film2");
    run_well(*saved, on);
}

TEST_F(FrameFolder, MayStayEmpty) {
    Script script = load(filmed_spots);
    RunRequest wanted = request();
    wanted.save = path("saved");
    run_well(script, wanted);
    auto saved = load_saved_script(path("saved"), {});
    ASSERT_TRUE(saved);
    RunRequest on = frames_in("film");  // The saved run is complete, so there is nothing to draw.
    on.resume = path("saved");
    run_well(*saved, on);
    EXPECT_THAT(names("film"), testing::IsEmpty());
}

TEST_F(FrameFolder, IsNotCalledLikeAMovie) {
    EXPECT_TRUE(is_called_like_a_movie("a/film.MP4"));
    EXPECT_TRUE(is_called_like_a_movie("film.gif"));
    EXPECT_FALSE(is_called_like_a_movie("film.frames"));
    EXPECT_FALSE(is_called_like_a_movie("mp4"));
    Script script = load(filmed_spots);
    run_badly(script, frames_in("film.mp4"));
    EXPECT_THAT(script.messages(false), HasSubstr("film.mp4 writes a film"));
    EXPECT_FALSE(std::filesystem::exists(path("film.mp4")));
}

}  // namespace
}  // namespace cascade
