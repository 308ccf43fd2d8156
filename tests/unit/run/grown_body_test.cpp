// Bodies that fields have grown: when they are made or given up, and how they are drawn below the
// cells on them.
#include "run/pictures/painter.h"
#include "run/simulation/tissue_stage.h"
#include "unit/run/ran_text.h"

#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

/// A ball of radius 0.3 in the middle, and one cell on it where y is largest.
std::string cell_on_ball(const std::string& picture) {
    return R"(
domain { grid: 24, 24, 24; boundary: noflux }
system ball { u: 0.3 - sqrt((x - 0.5)^2 + (y - 0.5)^2 + (z - 0.5)^2); u' = 0 }
cells still { p' = vector(0, 0, 0) }
stage grown: ball { iterations: 1 }
stage skin: still { founders: keys(0.5, 0.9, 0.5); r: 0.05; body: grown.u; iterations: 1 }
picture { color: rgb(0, 1, 0); )" +
           picture + " }\n";
}

Image drawn(const std::string& text) {
    Ran ran = run_text(text);
    PictureRequest request;
    request.view.azimuth = request.view.elevation = 0;
    auto painter = Painter::create(ran.script, request);
    EXPECT_TRUE(painter);
    return painter->image(painter->canvas(*ran.simulation));
}

/// The name of the largest channel of a pixel, and "" for a grey pixel.
std::string tint(const Colour& pixel) {
    std::size_t most = 0;
    for (std::size_t k = 1; k < 3; ++k) most = pixel[k] > pixel[most] ? k : most;
    const std::string names[] = {"red", "green", "blue"};
    for (std::size_t k = 0; k < 3; ++k) {
        if (k != most && pixel[k] > 0.5F * pixel[most]) return "";
    }
    return names[most];
}

TEST(GrownBody, LiesBelowItsCellsInPictures) {
    const Image image = drawn(
        cell_on_ball("skin: if(z > 0.5, rgb(1, 0, 0), if(x > 0.5, rgb(0, 0, 1), rgb(1, 0, 0)))"));
    const std::int64_t x = image.width / 2, y = image.height / 2, away = image.height / 4;
    EXPECT_EQ(tint(image.at(x, y)), "green") << "y of scripts comes towards the viewer";
    EXPECT_EQ(tint(image.at(x + away, y + away)), "blue");
    EXPECT_EQ(tint(image.at(x - away, y + away)), "red");
    EXPECT_EQ(tint(image.at(x + away, y - away)), "red") << "z is upwards";
    EXPECT_EQ(tint(image.at(2, 2)), "");
}

TEST(GrownBody, HasOneColourWithoutASkin) {
    const Image image = drawn(cell_on_ball("width: 0"));
    const Colour& pixel = image.at(image.width / 2, image.height / 2);
    EXPECT_EQ(tint(pixel), "");
    EXPECT_LT(pixel[0], 0.6F) << "the body is not the white background";
}

TEST(GrownBody, IsGivenUpWhenItIsCancelled) {
    Script script = load_script("test", cell_on_ball(""), ".");
    ASSERT_TRUE(script.program) << script.messages(false);
    auto simulation = Simulation::create(script, {"interp", 0, 1});
    ASSERT_TRUE(simulation);
    RunControl control;
    ASSERT_TRUE((*simulation)->start_stage(0));
    ASSERT_TRUE((*simulation)->advance_stage(0, 1, control, {}));
    control.cancel = true;
    const auto given_up = (*simulation)->start_stage(1, control.cancel);
    ASSERT_FALSE(given_up);
    EXPECT_EQ(given_up.error().message, "stopped while the body of stage 'skin' was made");
    EXPECT_FALSE((*simulation)->state(1).started);
    control.cancel = false;
    EXPECT_TRUE((*simulation)->start_stage(1, control.cancel));
    EXPECT_TRUE(body_under_cells((*simulation)->state(1)));
}

TEST(GrownBody, NothingAtAllIsAnEmptyPicture) {
    const std::string text = R"(
cells still { p' = vector(0, 0, 0) }
domain { grid: 8, 8, 8 }
stage stand: still { founders: 3; iterations: 1 }
picture { width: 0; color: rgb(0, 1, 0) }
)";
    const Image image = drawn(text);
    for (const Colour& pixel : image.pixels) ASSERT_EQ(pixel, (Colour{1, 1, 1}));
}

}  // namespace
}  // namespace cascade
