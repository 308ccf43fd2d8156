// Frames are drawn one after the other in the same memory, or straight into files. Each one equals
// the picture of a run that stops at its step.
#include "run_fixture.h"

#include "picture/grey_picture.h"
#include "run/pictures/frame_folder.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

struct FrameLook {
    const char* what;
    const char* domain = "";
    const char* show = "";
    const char* palette = "grey";
    PngDepth depth = PngDepth::eight;
};

constexpr FrameLook frame_looks[] = {
    {"greys"},
    {"many greys", "", "", "grey", PngDepth::sixteen},
    {"a palette of colours", "", "", "viridis"},
    {"a mask", "; mask: (x - 0.5)^2 + (y - 0.4)^2 < 0.12"},
    {"a mask with colours", "; mask: x + y < 1", "", "zebra"},
    {"colours of formulas", "", "rgb(a / 8, b / 8, 0.3)"},
    {"no numbers", "", "log(b - 4)"},
    {"one value alone", "", "0 * a + 2"},
};

class FramePictures : public RunTest {};

TEST_F(FramePictures, AreThoseOfRunsThatStopThere) {
    for (const FrameLook& look : frame_looks) {
        Script script = load(std::string("domain { grid: 50, 30") + look.domain +
                             " }\nstage s: turing_spots { iterations: 40; interval: 10 }\n");
        ASSERT_FALSE(script.diagnostics.has_errors()) << look.what;
        RunRequest wanted = request();
        wanted.frames = path("film");
        wanted.picture.show = look.show;
        wanted.picture.palette = look.palette;
        wanted.picture.range = ValueRange{3, 5};
        wanted.picture.depth = look.depth == PngDepth::sixteen ? 16 : 8;
        std::vector<std::string> of_one_thread;
        for (const int threads : {1, 3}) {
            wanted.simulation.threads = threads;
            for (const std::int64_t step : {0, 20, 40}) {
                wanted.stop_at = StopAt{"s", step};
                run_well(script, wanted);
                const std::string frame =
                    "film/" + frame_name(static_cast<std::size_t>(step / 10), "s", step);
                const auto drawn = read_grey_picture(path(frame));
                const auto picture = read_grey_picture(path("picture.png"));
                ASSERT_TRUE(drawn && picture) << look.what;
                EXPECT_EQ(drawn->width, 50) << look.what;
                EXPECT_EQ(drawn->values, picture->values) << look.what << ", step " << step;
                if (threads == 1) of_one_thread.push_back(bytes(frame));
                else EXPECT_EQ(bytes(frame), of_one_thread[static_cast<std::size_t>(step / 20)]);
            }
        }
    }
}

}  // namespace
}  // namespace cascade
