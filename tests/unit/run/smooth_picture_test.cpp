// Smooth pictures of planes (--size), and copies side by side (--copies).
#include "run/pictures/painter.h"
#include "run/pictures/picture_size.h"
#include "run_fixture.h"
#include "unit/run/ran_text.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

namespace cascade {
namespace {

using testing::HasSubstr;

std::string plane(const std::string& domain, const std::string& value,
                  const std::string& picture = "") {
    return "domain { " + domain + " }\nsystem still { u: " + value +
           "; u' = 0 }\nstage shown: still { iterations: 1 }\n" +
           (picture.empty() ? "" : "picture { " + picture + " }\n");
}

PictureRequest smooth(std::int64_t width, std::int64_t height) {
    PictureRequest request;
    request.size = PictureSize{width, height};
    request.range = ValueRange{0, 1};
    return request;
}

Image drawn(const std::string& text, const PictureRequest& request) {
    Ran ran = run_text(text);
    auto painter = Painter::create(ran.script, request);
    EXPECT_TRUE(painter);
    Image image = painter->image(painter->canvas(*ran.simulation));
    EXPECT_EQ(picture_size(ran.script, request), (PictureSize{image.width, image.height}));
    return image;
}

TEST(SmoothPicture, AWaveIsThatOfTheFormula) {
    const Image image =
        drawn(plane("grid: 16, 16", "0.5 + 0.5 * cos(2 * pi * x) * sin(2 * pi * y)"),
              smooth(160, 160));
    ASSERT_EQ(image.width, 160);
    ASSERT_EQ(image.height, 160);
    for (std::int64_t y = 0; y < 160; ++y) {
        for (std::int64_t x = 0; x < 160; ++x) {
            const auto angle = [](std::int64_t k) {
                return 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / 160;
            };
            const double value = 0.5 + 0.5 * std::cos(angle(x)) * std::sin(angle(y));
            ASSERT_NEAR(static_cast<double>(image.at(x, y)[0]), value, 0.01) << x << ' ' << y;
        }
    }
}

TEST(SmoothPicture, FitsIntoItsSizeInProportion) {
    const auto size_of = [](const char* grid, PictureRequest request) {
        const Image image = drawn(plane(grid, "0.5"), request);
        return PictureSize{image.width, image.height};
    };
    EXPECT_EQ(size_of("grid: 24, 12", smooth(100, 100)), (PictureSize{100, 50}));
    EXPECT_EQ(size_of("grid: 24, 12", smooth(100, 20)), (PictureSize{40, 20}));
    EXPECT_EQ(size_of("grid: 24, 12", smooth(1, 1)), (PictureSize{1, 1}));
    EXPECT_EQ(size_of("grid: 64", smooth(640, 480)), (PictureSize{640, 10}));
    EXPECT_EQ(size_of("grid: 20, 12, 8", smooth(400, 400)), (PictureSize{400, 240}));
    PictureRequest copies = smooth(100, 100);
    copies.copies = {3, 2};
    EXPECT_EQ(size_of("grid: 24, 12", copies), (PictureSize{99, 34}));
    copies.scale = 2;
    EXPECT_EQ(size_of("grid: 24, 12", copies), (PictureSize{198, 68}));
    // If there are fewer pixels than cells, each pixel is the mean of its cells.
    const Image small =
        drawn(plane("grid: 64, 64", "if(mod(floor(64 * x), 2) < 1, 0, 1)"), smooth(16, 16));
    for (const Colour& pixel : small.pixels) EXPECT_NEAR(pixel[0], 0.735F, 0.03F);
}

TEST(SmoothPicture, OutlinesOfThresholdsAreRound) {
    const std::string disc = plane("grid: 24, 24", "sqrt((x - 0.5)^2 + (y - 0.5)^2)",
                                   "color: if(u < 0.3, rgb(1, 1, 1), rgb(0, 0, 0))");
    const Image image = drawn(disc, smooth(480, 480));
    double light = 0;
    for (const Colour& pixel : image.pixels) light += pixel[0] > 0.5F ? 1 : 0;
    const double area = std::numbers::pi * 0.3 * 0.3;
    EXPECT_NEAR(light / (480.0 * 480), area, 0.01 * area);
    for (std::int64_t k = 0; k < 480; ++k) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(k) / 480;
        const auto at = [&](double radius) {
            return image.at(std::llround(239.5 + 480 * radius * std::cos(angle)),
                            std::llround(239.5 + 480 * radius * std::sin(angle)))[0];
        };
        EXPECT_GT(at(0.29), 0.9F) << k;  // A fifth of a cell away from the outline.
        EXPECT_LT(at(0.31), 0.1F) << k;
    }
}

TEST(SmoothPicture, SumsCountTheCellsOfTheRun) {
    // Half of the plane is above the mean.
    for (const char* mean : {"sum(u over domain) / 256", "integral(u over domain) / 64"}) {
        const Image image =
            drawn(plane("grid: 16, 16; spacing: 0.5; boundary: noflux", "x",
                        std::string("color: if(u > ") + mean + ", rgb(1, 1, 1), rgb(0, 0, 0))"),
                  smooth(160, 160));
        double light = 0;
        for (const Colour& pixel : image.pixels) light += static_cast<double>(pixel[0]);
        EXPECT_NEAR(light / (160.0 * 160), 0.5, 0.03) << mean;
    }
}

TEST(SmoothPicture, BordersOfMasksAreSoft) {
    const Image image =
        drawn(plane("grid: 24, 24; mask: disc(0.5, 0.5, 0.3)", "0.5"), smooth(240, 240));
    ASSERT_EQ(image.alpha.size(), image.pixels.size());
    EXPECT_EQ(image.opacity(120, 120), 1);
    EXPECT_EQ(image.opacity(2, 2), 0);
    EXPECT_NEAR(image.at(120, 120)[0], 0.5F, 0.01F);
    std::size_t between = 0;
    for (const float alpha : image.alpha) between += alpha > 0.1F && alpha < 0.9F ? 1 : 0;
    EXPECT_GT(between, 500u);
}

TEST(SmoothPicture, CopiesJoin) {
    const std::string text =
        plane("grid: 16, 12", "0.5 + 0.5 * cos(2 * pi * sx + 1) * sin(2 * pi * sy + 1)");
    PictureRequest request = smooth(192, 96);
    request.copies = {3, 2};
    const Image image = drawn(text, request);
    ASSERT_EQ(image.width, 192);
    ASSERT_EQ(image.height, 96);
    float largest = 0;
    for (std::int64_t y = 0; y < 96; ++y) {
        for (std::int64_t x = 0; x < 192; ++x) {
            ASSERT_EQ(image.at(x, y), image.at(x % 64, y % 48));
            if (x > 0)
                largest = std::max(largest, std::abs(image.at(x, y)[0] - image.at(x - 1, y)[0]));
            if (y > 0)
                largest = std::max(largest, std::abs(image.at(x, y)[0] - image.at(x, y - 1)[0]));
        }
    }
    EXPECT_LT(largest, 0.08F);  // The largest slope is 0.5 · 2π/48, and there is no jump at seams.
    PictureRequest squares;
    squares.copies = {2, 1};
    squares.scale = 3;
    EXPECT_EQ(drawn(text, squares).width, 2 * 16 * 3);
}

using SmoothPictureRun = RunTest;

TEST_F(SmoothPictureRun, WhatCannotBeIsRefused) {
    const auto reason = [&](const std::string& text, const PictureRequest& picture) {
        Script script = load(text);
        RunRequest wanted = request();
        wanted.picture = picture;
        RunControl control;
        EXPECT_FALSE(run(script, wanted, control));
        return script.messages(false);
    };
    PictureRequest copies;
    copies.copies = {2, 1};
    EXPECT_THAT(reason(plane("grid: 8, 8; boundary: noflux", "0"), copies),
                HasSubstr("the pattern does not repeat across its left and right sides"));
    EXPECT_THAT(reason(plane("surface: sphere; cells: 200", "0"), copies),
                HasSubstr("only planes can be drawn in copies"));
    copies.copies = {1, 2};
    EXPECT_THAT(reason(plane("grid: 8, 8; boundary: periodic, noflux", "0"), copies),
                HasSubstr("the pattern does not repeat across its upper and lower sides"));
    PictureRequest rows = smooth(100, 100);
    rows.space_time = true;
    EXPECT_THAT(reason(plane("grid: 8", "0"), rows),
                HasSubstr("the size of a space-time picture is fixed: one pixel for each cell "
                          "and interval"));
    Script script = load(plane("grid: 8, 8", "0"));
    RunRequest wanted = request();
    wanted.picture = smooth(1 << 20, 1 << 20);
    EXPECT_THAT(run_badly(script, wanted), HasSubstr("has more than 268435456 pixels"));
}

}  // namespace
}  // namespace cascade
