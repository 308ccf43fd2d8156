// Patterns and pictures of domains that grow.
#include "run/pictures/frames.h"
#include "run/pictures/measured.h"
#include "run/simulation/grown_domain.h"
#include "unit/run/ran_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// How often the values along a line cross the middle of their range.
int crossings(const Field& line, std::int64_t cells) {
    std::vector<double> values;
    for (std::int64_t i = 0; i < cells; ++i) values.push_back(line.number_at(i, 0));
    const auto [least, most] = std::ranges::minmax(values);
    int count = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double middle = (least + most) / 2;
        count += (values[i - 1] < middle) != (values[i] < middle) ? 1 : 0;
    }
    return count;
}

/// On an exponentially growing line each half wave of Schnakenberg's pattern becomes two, again and
/// again, once in the time in which the line doubles (E. J. Crampin, E. A. Gaffney and P. K. Maini,
/// Bulletin of Mathematical Biology 61, 1093, 1999, figure 2).
TEST(GrowingDomains, ModesDoubleEachTimeTheLineDoubles) {
    Ran ran;
    ran.script = load_script("modes",
                             "system s {\n"
                             "  u: 1 + 0.05 * cos(pi * sx)\n"
                             "  v: 0.9\n"
                             "  u' = 0.1 - u + u^2 * v + 0.01 * lap(u)\n"
                             "  v' = 0.9 - u^2 * v + lap(v)\n"
                             "}\n"
                             "domain { grid: 128; extent: exp(0.01 * t); boundary: noflux }\n"
                             "stage skin: s { solver: rkl2; speed: auto; duration: 300 }\n",
                             ".");
    ASSERT_TRUE(ran.script.program) << ran.script.messages(false);
    ran.simulation = std::move(*Simulation::create(ran.script, {"interp", 0, 1}));
    ASSERT_TRUE(ran.simulation->start_stage(0));
    RunControl control;
    std::vector<int> modes;
    std::vector<double> since;
    const auto observe = [&] {
        const int now = crossings(ran.species(), 128);
        if (!modes.empty() && modes.back() == now) return;
        modes.push_back(now);
        since.push_back(ran.state().t);
    };
    const auto next = [](double t) { return 5 * (std::floor(t / 5 + 1e-9) + 1); };
    const std::int64_t most = ran.script.program->stages[0].iterations;
    ASSERT_TRUE(ran.simulation->advance_stage(0, most, control, observe, 0, next));
    EXPECT_THAT(modes, ::testing::ElementsAre(1, 2, 4, 8, 16));
    for (std::size_t k = 2; k < since.size(); ++k) {
        EXPECT_NEAR(since[k] - since[k - 1], std::numbers::ln2 / 0.01, 6) << modes[k];
    }
}

/// The wavelength that is measured is the one in the grown domain.
TEST(GrowingDomains, FeaturesHaveLengthsOfTheMoment) {
    Ran ran = run_text(
        "system s { u: cos(8 * pi * sx); u' = 0; undiluted: u }\n"
        "domain { grid: 64, 32; extent: 64 + 64 * t, 32 }\n"
        "stage a: s { speed: 0.25; duration: 1 }\n");
    auto painter = Painter::create(ran.script, {});
    ASSERT_TRUE(painter);
    EXPECT_NEAR(measure_shown(*painter, *ran.simulation).wavelength, 32, 0.5);
    EXPECT_EQ(cell_lengths(*ran.simulation, 0), (std::array<double, 3>{2, 1, 1}));
}

/// A plane that grows along x alone is drawn longer, and frames of a film show it in the middle of
/// a picture of the final plane.
TEST(GrowingDomains, PicturesHaveTheirProportions) {
    Script script = load_script("film",
                                "system s { u: sx; u' = 0; undiluted: u }\n"
                                "domain { grid: 16, 8; extent: 16 * exp(t), 8 }\n"
                                "stage a: s { speed: 1; iterations: 1 }\n",
                                ".");
    ASSERT_TRUE(script.program) << script.messages(false);
    auto simulation = std::move(*Simulation::create(script, {"interp", 0, 1}));
    auto painter = std::move(*Painter::create(script, {}));
    auto frames = std::move(*FrameRecorder::create(true, false));
    ASSERT_TRUE(simulation->start_stage(0));
    frames.record(painter.canvas(*simulation), "a", 0);
    EXPECT_EQ(painter.image(painter.canvas(*simulation)).width, 16);
    RunControl control;
    ASSERT_TRUE(simulation->advance_stage(0, 1, control, {}));
    const Image image = painter.image(painter.canvas(*simulation));
    EXPECT_EQ(image.width, std::llround(16 * std::numbers::e));
    EXPECT_EQ(image.height, 8);
    frames.record(painter.canvas(*simulation), "a", 1);
    const std::vector<std::size_t> numbers{0, 1};
    std::vector<Image> drawn;
    const auto use = [&](std::size_t, const Image& each) -> Result<FrameRecorder::InOrder> {
        drawn.push_back(each);
        return [] { return Result<void>(); };
    };
    ASSERT_TRUE(frames.draw(painter, numbers, 1, never_cancelled, use));
    ASSERT_EQ(drawn.size(), 2u);
    for (const Image& each : drawn) {
        EXPECT_EQ(each.width, image.width);
        EXPECT_EQ(each.height, image.height);
    }
    int opaque = 0;
    for (std::int64_t x = 0; x < image.width; ++x) opaque += drawn[0].opacity(x, 4) > 0 ? 1 : 0;
    EXPECT_EQ(opaque, 16);
    EXPECT_EQ(drawn[1].pixels, image.pixels);
}

/// The number of pixels that an image shows of something.
int shown_pixels(const Image& image) {
    int count = 0;
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) count += image.opacity(x, y) > 0.5F ? 1 : 0;
    }
    return count;
}

/// A model whose lengths double covers four times the area in a film, and fills the last frame.
TEST(GrowingDomains, FilmsShowModelsToScale) {
    Script script = load_script("film",
                                "system s { u: sx; u' = 0; undiluted: u }\n"
                                "domain { surface: sphere; cells: 200; extent: 20 * (1 + t) }\n"
                                "stage a: s { speed: 1; iterations: 1 }\n",
                                ".");
    ASSERT_TRUE(script.program) << script.messages(false);
    auto simulation = std::move(*Simulation::create(script, {"interp", 0, 1}));
    PictureRequest request;
    request.size = PictureSize{200, 200};
    request.background = std::nullopt;
    auto painter = std::move(*Painter::create(script, request));
    auto frames = std::move(*FrameRecorder::create(true, false));
    ASSERT_TRUE(simulation->start_stage(0));
    frames.record(painter.canvas(*simulation), "a", 0);
    RunControl control;
    ASSERT_TRUE(simulation->advance_stage(0, 1, control, {}));
    frames.record(painter.canvas(*simulation), "a", 1);
    const std::vector<std::size_t> numbers{0, 1};
    std::vector<Image> drawn;
    const auto use = [&](std::size_t, const Image& each) -> Result<FrameRecorder::InOrder> {
        drawn.push_back(each);
        return [] { return Result<void>(); };
    };
    ASSERT_TRUE(frames.draw(painter, numbers, 1, never_cancelled, use));
    ASSERT_EQ(drawn.size(), 2u);
    const double most = shown_pixels(drawn[1]);
    EXPECT_GT(most, 0.4 * 200 * 200);
    EXPECT_NEAR(shown_pixels(drawn[0]) / most, 0.25, 0.02);
    EXPECT_EQ(shown_pixels(painter.image(painter.canvas(*simulation))), shown_pixels(drawn[1]));
}

/// On a sphere that grows, Schnakenberg's reaction makes more and more spots.
TEST(GrowingDomains, SpotsAreAddedOnASphereThatGrows) {
    Ran ran = run_text(
        "system s {\n"
        "  u: 1 + random(0, 0.05)\n"
        "  v: 0.9\n"
        "  u' = 0.1 - u + u^2 * v + 0.05 * lap(u)\n"
        "  v' = 0.9 - u^2 * v + 2 * lap(v)\n"
        "}\n"
        "domain { surface: sphere; cells: 1500; extent: 5 * exp(0.01 * t) }\n"
        "stage young: s { solver: rkl2; speed: auto; duration: 60 }\n"
        "stage old: s { u: u; v: v; solver: rkl2; speed: auto; duration: 70;\n"
        "  extent: 5 * exp(0.6 + 0.01 * t) }\n");
    ASSERT_EQ(ran.failure, "");
    const ModelCells& model = *ran.simulation->domain().model->cells;
    /// Cells whose value is larger than the values of all linked cells and 1.5.
    const auto peaks = [&](std::uint32_t stage) {
        const std::vector<double> values = cell_values(ran.state(stage).species()[0], model);
        const SurfaceCells& cells = model.spread().cells;
        int count = 0;
        std::size_t edge = 0;
        for (std::size_t cell = 0; cell < values.size(); ++cell) {
            bool is_peak = values[cell] > 1.5;
            for (; edge < cells.ends[cell]; ++edge) {
                is_peak = is_peak && values[cell] > values[cells.edges[edge].neighbour];
            }
            count += is_peak ? 1 : 0;
        }
        return count;
    };
    EXPECT_GE(peaks(0), 4);
    EXPECT_GE(peaks(1), 2 * peaks(0));
}

}  // namespace
}  // namespace cascade
