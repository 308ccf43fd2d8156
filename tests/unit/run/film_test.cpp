// Films of runs: what their frames show, where they end, and which requests are refused before the
// run.
#include "run_fixture.h"

#include "film/film.h"
#include "picture/grey_picture.h"
#include "run/commands/film_crew.h"
#include "run/pictures/frame_folder.h"

#include <gif_lib.h>
#include <gmock/gmock.h>

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A GIF film whose frames each replace the one before. `frames` has the red channel of each frame,
/// and is empty if the file cannot be read to its end.
struct Film {
    std::vector<std::vector<int>> frames;
    std::vector<int> times;  ///< In hundredths of a second.
    int width = 0, height = 0;
};

Film read_gif(const std::filesystem::path& path) {
    Film film;
    int error = 0;
    GifFileType* const gif = DGifOpenFileName(path.c_str(), &error);
    if (!gif) return film;
    if (DGifSlurp(gif) == GIF_OK) {
        film.width = gif->SWidth;
        film.height = gif->SHeight;
        std::vector<int> canvas(static_cast<std::size_t>(gif->SWidth * gif->SHeight));
        for (int k = 0; k < gif->ImageCount; ++k) {
            const SavedImage& image = gif->SavedImages[k];
            const GifImageDesc& part = image.ImageDesc;
            const ColorMapObject* map = part.ColorMap ? part.ColorMap : gif->SColorMap;
            for (int y = 0; y < part.Height; ++y) {
                for (int x = 0; x < part.Width; ++x) {
                    canvas[static_cast<std::size_t>((part.Top + y) * gif->SWidth + part.Left + x)] =
                        map->Colors[image.RasterBits[y * part.Width + x]].Red;
                }
            }
            GraphicsControlBlock control;
            DGifSavedExtensionToGCB(gif, k, &control);
            film.times.push_back(control.DelayTime);
            film.frames.push_back(canvas);
        }
    }
    DGifCloseFile(gif, &error);
    return film;
}

class FilmRun : public RunTest {
protected:
    RunRequest film(const std::string& name) const {
        RunRequest wanted = request();
        wanted.outputs = {path(name)};
        return wanted;
    }
    std::vector<int> levels(const std::filesystem::path& picture) const {
        const auto read = read_grey_picture(picture);
        EXPECT_TRUE(read) << picture;
        std::vector<int> levels;
        if (!read) return levels;
        for (const float value : read->values)
            levels.push_back(static_cast<int>(value * 255 + 0.5F));
        return levels;
    }
    std::vector<std::filesystem::path> sorted(const std::string& folder) const {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(path(folder))) {
            files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
        return files;
    }
};

TEST_F(FilmRun, HasThePixelsOfFrames) {
    Script script = load(two_stages);
    for (const int threads : {1, 3}) {
        RunRequest wanted = film("a.gif");
        wanted.outputs.push_back(path("b.apng"));
        wanted.frames = path("frames");
        wanted.picture.scale = 2;
        wanted.simulation.threads = threads;
        const RunReport report = run_well(script, wanted);
        EXPECT_THAT(report.written, testing::Contains(path("b.apng")));
        const auto frames = sorted("frames");
        const Film film = read_gif(path("a.gif"));
        EXPECT_EQ(film.width, 48);
        // The steps 0, 100, 200, 300 of the first stage, and 50, 100, 150, 200 of the second.
        ASSERT_EQ(film.frames.size(), 8U);
        ASSERT_EQ(frames.size(), 8U);
        for (std::size_t k = 0; k < frames.size(); ++k) {
            EXPECT_EQ(film.frames[k], levels(frames[k])) << frames[k];
        }
        EXPECT_THAT(film.times, testing::Each(10));
        // The first frame of an APNG is an ordinary picture, which carries the script.
        EXPECT_EQ(levels(path("b.apng")), levels(frames[0]));
        EXPECT_EQ(read_png_texts(path("b.apng"))->at("Cascade script"), two_stages);
    }
}

TEST_F(FilmRun, KeepsOneRangeForAllFrames) {
    // u grows from 1 … 2 to 2.7 … 5.4. If each frame had its own range, all frames would be alike.
    Script script = load(R"(
system g { u: 1 + x; u' = 0.01 * u }
domain { grid: 32, 4 }
stage s: g { iterations: 100; interval: 50 }
)");
    run_well(script, film("a.gif"));
    const Film film = read_gif(path("a.gif"));
    ASSERT_EQ(film.frames.size(), 3U);
    EXPECT_EQ(film.frames[0].front(), 0);
    EXPECT_EQ(film.frames[2].back() / 16, 15);
    EXPECT_LT(film.frames[0].back(), film.frames[2].front());
    EXPECT_LT(film.frames[0].front(), film.frames[1].front());
    EXPECT_LT(film.frames[1].front(), film.frames[2].front());
}

TEST_F(FilmRun, LastsAsLongAsAsked) {
    Script script = load(two_stages);
    RunRequest wanted = film("a.gif");
    wanted.film.seconds = 2;
    run_well(script, wanted);
    EXPECT_THAT(read_gif(path("a.gif")).times, testing::Each(25));
    wanted.film = {.frames_per_second = 40};
    run_well(script, wanted);
    EXPECT_THAT(read_gif(path("a.gif")).times, ElementsAre(3, 2, 3, 2, 3, 2, 3, 2));
}

TEST(FilmPlans, LeaveOutFramesEvenly) {
    const FilmPlan all = film_plan({}, 4, false);
    EXPECT_THAT(all.frames, ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(all.frames_per_second, 10);
    // 0.1 s of a GIF are 5 frames at most.
    const FilmPlan few = film_plan({.seconds = 0.1}, 101, true);
    EXPECT_THAT(few.frames, ElementsAre(0, 25, 50, 75, 100));
    EXPECT_DOUBLE_EQ(few.frames_per_second, 50);
    const FilmPlan one = film_plan({.seconds = 3600}, 1, true);
    EXPECT_THAT(one.frames, ElementsAre(0));
    EXPECT_EQ(one.frames_per_second, slowest_film);
}

TEST_F(FilmRun, EndsWhereTheRunIsStopped) {
    Script script = load(two_stages);
    RunRequest wanted = film("a.gif");
    RunControl control;
    control.report = [&](const Progress& progress) {
        if (progress.step >= 200) control.cancel = true;
    };
    const auto report = run(script, wanted, control);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->status, RunStatus::cancelled);
    EXPECT_GE(read_gif(path("a.gif")).frames.size(), 3U);
}

TEST_F(FilmRun, EndsWhereDrawingIsStopped) {
    Script script = load(two_stages);
    RunRequest wanted = film("a.gif");
    wanted.outputs.push_back(path("b.apng"));
    RunControl control;
    control.report = [&](const Progress& progress) {
        if (progress.doing == "drawing 3 of 8") control.cancel = true;
    };
    const auto report = run(script, wanted, control);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->status, RunStatus::cancelled);
    EXPECT_THAT(report->where, HasSubstr("frame 3 of 8 of"));
    EXPECT_EQ(read_gif(path("a.gif")).frames.size(), 3U);
    EXPECT_TRUE(read_png_texts(path("b.apng")));
}

TEST_F(FilmRun, TurnsOnceAroundASurface) {
    Script script = load(R"(
system g { u: x; u' = 0 }
domain {
  grid: 12, 6
  surface: (3 + cos(2*pi*sy)) * cos(2*pi*sx), (3 + cos(2*pi*sy)) * sin(2*pi*sx), sin(2*pi*sy)
}
stage s: g { iterations: 1 }
)");
    ASSERT_FALSE(script.diagnostics.has_errors()) << script.messages(false);
    RunRequest wanted = film("a.gif");
    wanted.turntable = 2;
    run_well(script, wanted);
    const Film film = read_gif(path("a.gif"));
    ASSERT_EQ(film.frames.size(), 2U);
    EXPECT_EQ(film.width, 800);
    EXPECT_NE(film.frames[0], film.frames[1]);
    EXPECT_THAT(sorted("."), testing::SizeIs(1));
}

TEST_F(FilmRun, CarriesLabels) {
    Script script = load(two_stages);
    const auto labelled = [&](std::vector<std::string> labels, const std::string& name) {
        RunRequest wanted = film(name + ".gif");
        wanted.frames = path(name);
        wanted.picture.scale = 10;
        wanted.labels = std::move(labels);
        run_well(script, wanted);
        return read_gif(path(name + ".gif"));
    };
    const Film plain = labelled({}, "plain"), steps = labelled({"stage", "step"}, "steps");
    const Film means = labelled({"mean(b over domain)", "ka"}, "means");
    ASSERT_EQ(plain.frames.size(), 8U);
    const std::size_t plate = 240 * (180 - 15);  // The number of pixels above the label.
    for (std::size_t k = 0; k < 8; ++k) {
        const auto top = [&](const std::vector<int>& levels) {
            return std::vector<int>(levels.begin(), levels.begin() + plate);
        };
        EXPECT_EQ(top(steps.frames[k]), top(plain.frames[k]));
        EXPECT_NE(steps.frames[k], plain.frames[k]);
        EXPECT_NE(steps.frames[k], means.frames[k]);
        // Frames that are separate pictures have the label, too.
        const auto picture = levels(sorted("steps")[k]);
        EXPECT_EQ(top(picture), top(plain.frames[k]));
        EXPECT_NE(picture, levels(sorted("plain")[k]));
    }
    RunRequest small = film("small.gif");
    small.labels = {"step"};
    small.picture.scale = 1;
    EXPECT_THAT(run_badly(script, small), HasSubstr("24 × 18 pixels have no room for a label"));
}

TEST_F(FilmRun, ShowsTheSlicesOfAVolumeInOneRange) {
    Script script = load(R"(
system g { u: x + 2 * z; u' = 0 }
domain { grid: 6, 5, 4 }
stage s: g { iterations: 1 }
)");
    RunRequest wanted = film("a.gif");
    wanted.slices = 4;
    run_well(script, wanted);
    const Film film = read_gif(path("a.gif"));
    ASSERT_EQ(film.frames.size(), 4U);
    EXPECT_EQ(film.width, 6);
    EXPECT_EQ(film.frames[0].front(), 0);
    EXPECT_EQ(film.frames[3].back(), 255);
    for (std::size_t k = 1; k < 4; ++k) EXPECT_GT(film.frames[k][0], film.frames[k - 1][0] + 30);
}

TEST_F(FilmRun, IsRefusedWithoutFrames) {
    Script script = load(two_stages);
    Overrides none;
    none.steps = 0;
    Script still = load(two_stages, none);
    EXPECT_THAT(run_badly(still, film("a.gif")), HasSubstr("has no frames"));
    RunRequest saved = request();
    saved.save = path("saved");
    run_well(script, saved);
    auto again = load_saved_script(path("saved"), {});
    ASSERT_TRUE(again);
    RunRequest on = film("a.gif");
    on.resume = path("saved");
    EXPECT_THAT(run_badly(*again, on), HasSubstr("has no frames"));
    EXPECT_FALSE(std::filesystem::exists(path("a.gif")));
}

TEST_F(FilmRun, IsRefusedBeforeTheFirstStep) {
    Script script = load("domain { grid: 2000, 2 }\nstage s: turing_spots { iterations: 9 }\n");
    RunRequest wide = film("a.webp");
    wide.picture.scale = 9;
    EXPECT_THAT(run_badly(script, wide), HasSubstr("cannot hold frames of 18000 × 18 pixels"));
    EXPECT_THAT(run_badly(script, film("no/a.gif")), HasSubstr("there is no folder"));
    ASSERT_EQ(::mkfifo(path("pipe.gif").c_str(), 0600), 0);
    EXPECT_THAT(run_badly(script, film("pipe.gif")), HasSubstr("it is a pipe or a device"));

    const auto refused = [&](const RunRequest& wanted) {
        Script again = load("domain { grid: 2000, 2 }\nstage s: turing_spots { iterations: 9 }\n");
        run_badly(again, wanted);
        return again.messages(false);
    };
    RunRequest fast = film("a.gif");
    fast.film.frames_per_second = 60;
    EXPECT_THAT(refused(fast), HasSubstr("a GIF shows at most 50 frames a second"));
    RunRequest none = request();
    none.film.seconds = 5;
    EXPECT_THAT(refused(none), HasSubstr("no film is written"));
    RunRequest rows = film("a.gif");
    rows.picture.space_time = true;
    EXPECT_THAT(refused(rows), HasSubstr("a space-time picture cannot be written as a film"));
}

TEST_F(FilmRun, LeavesNothingOnAFullDisk) {
    std::signal(SIGXFSZ, SIG_IGN);
    Script script = load(
        "domain { grid: 64, 64 }\nstage s: turing_spots { iterations: 40; interval: "
        "2 }\n");
    RunRequest wanted = film("a.apng");
    ASSERT_TRUE(write_file(path("a.apng"), "an older film"));
    rlimit usual{};
    getrlimit(RLIMIT_FSIZE, &usual);
    RunControl control;
    control.report = [&](const Progress& progress) {
        // The temporary file has room for 21 frames of 64² cells of 4 bytes before it fails.
        const rlimit small{20000, usual.rlim_max};
        if (progress.doing == "drawing 4 of 21") setrlimit(RLIMIT_FSIZE, &small);
    };
    const auto report = run(script, wanted, control);
    setrlimit(RLIMIT_FSIZE, &usual);
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message, HasSubstr("a.apng': File too large"));
    EXPECT_EQ(*read_file(path("a.apng"), 100), "an older film");
    EXPECT_EQ(sorted(".").size(), 1U);
}

}  // namespace
}  // namespace cascade
