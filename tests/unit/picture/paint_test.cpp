// Fields to pixels: ranges, palettes, channels, enlarging.
#include "picture/image.h"

#include "tests/support/not_finite.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

namespace cascade {
namespace {

using test::infinity;
using test::nan;
constexpr Colour magenta{1, 0, 1};

/// One row of cells. The halo contains values that must never be read.
Field row_of(std::initializer_list<float> values) {
    Field field(PlaneLayout(Grid{static_cast<std::int64_t>(values.size()), 1}));
    const PlaneLayout& layout = field.layout();
    for (std::int64_t j = -1; j <= layout.height; ++j) {
        for (std::int64_t i = -1; i <= layout.width; ++i) field.at(i, j) = 1e30F;
    }
    std::int64_t i = 0;
    for (const float value : values) field.at(i++, 0) = value;
    return field;
}

const Palette& grey() { return *find_palette("grey"); }

void expect_grey(const Colour& colour, float value) {
    for (const float channel : colour) EXPECT_NEAR(channel, value, 1e-6F);
}

TEST(ValueRange, SmallestAndLargestFiniteValue) {
    const ValueRange range =
        automatic_range(spread_of(row_of({3, nan, -2, infinity, 5, -infinity})));
    EXPECT_EQ(range.low, -2);
    EXPECT_EQ(range.high, 5);
}

TEST(ValueRange, NoFiniteValue) {
    const ValueRange range = automatic_range(spread_of(row_of({nan, infinity})));
    EXPECT_EQ(range.low, 0);
    EXPECT_EQ(range.high, 0);
}

TEST(ValueRange, RoundingIsNotStretched) {
    const Field field = row_of({1.0F, 1.0000002F, 1.0F});
    const ValueRange range = automatic_range(spread_of(field));
    EXPECT_EQ(range.low, range.high);
    const Image image = paint(field, range, grey());
    EXPECT_EQ(image.at(0, 0), image.at(1, 0));
    expect_grey(image.at(1, 0), 0.5F);
    const ValueRange faint = automatic_range(spread_of(row_of({1, 1.001F})));
    EXPECT_LT(faint.low, faint.high);
}

TEST(Paint, ValuesThroughAPalette) {
    const Image image = paint(row_of({2, 3, 4, 6, 7, 1}), {2, 6}, grey());
    ASSERT_EQ(image.width, 6);
    ASSERT_EQ(image.height, 1);
    expect_grey(image.at(0, 0), 0);
    expect_grey(image.at(1, 0), 0.25F);
    expect_grey(image.at(2, 0), 0.5F);
    expect_grey(image.at(3, 0), 1);
    expect_grey(image.at(4, 0), 1);
    expect_grey(image.at(5, 0), 0);
}

TEST(Paint, SwappedEndsTurnThePaletteRound) {
    const Image image = paint(row_of({0, 1, 4}), {4, 0}, grey());
    expect_grey(image.at(0, 0), 1);
    expect_grey(image.at(1, 0), 0.75F);
    expect_grey(image.at(2, 0), 0);
}

TEST(Paint, RangeWithoutWidthGivesTheMiddle) {
    const Image image = paint(row_of({-1, 5, infinity, nan}), {5, 5}, grey());
    for (int i = 0; i < 3; ++i) expect_grey(image.at(i, 0), 0.5F);
    EXPECT_EQ(image.at(3, 0), magenta);
}

TEST(Paint, ValuesThatAreNotFinite) {
    const Image image = paint(row_of({nan, infinity, -infinity}), {0, 1}, grey());
    EXPECT_EQ(image.at(0, 0), magenta);
    expect_grey(image.at(1, 0), 1);
    expect_grey(image.at(2, 0), 0);
}

TEST(Paint, TheWidestRangeDoesNotOverflow) {
    constexpr float most = std::numeric_limits<float>::max();
    const Image image = paint(row_of({-most, 0, most}), {-most, most}, grey());
    expect_grey(image.at(0, 0), 0);
    expect_grey(image.at(1, 0), 0.5F);
    expect_grey(image.at(2, 0), 1);
}

TEST(Paint, RowsKeepTheirOrder) {
    Field field(PlaneLayout(Grid{2, 3}));
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 2; ++i) field.at(i, j) = static_cast<float>(2 * j + i);
    }
    const Image image = paint(field, {0, 5}, grey());
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 2; ++i) {
            expect_grey(image.at(i, j), static_cast<float>(2 * j + i) / 5);
        }
    }
}

TEST(Paint, ThreeFieldsAreChannels) {
    const Image image = paint(row_of({0.25F, -1, 0}), row_of({0.5F, 2, nan}), row_of({1, 0, 0}));
    EXPECT_EQ(image.at(0, 0), (Colour{0.25F, 0.5F, 1}));
    EXPECT_EQ(image.at(1, 0), (Colour{0, 1, 0}));
    EXPECT_EQ(image.at(2, 0), magenta);
}

TEST(Paint, ChannelsOfDifferentSizesAreOurMistake) {
    const Field two = row_of({0, 1});
    const Field three = row_of({0, 1, 2});
    EXPECT_DEATH(paint(two, two, three), "one layout");
}

TEST(Paint, ValuesGetTheColoursOfAField) {
    std::vector<float> values;
    for (int k = 0; k < 700; ++k) values.push_back(static_cast<float>(k % 97) / 40 - 0.2F);
    values[300] = std::numeric_limits<float>::quiet_NaN();
    for (const char* name : {"grey", "viridis", "#fff #203040 #f80"}) {
        const Palette& palette = *find_palette(name);
        std::vector<Colour> colours(values.size());
        paint(values, {0.1F, 1.7F}, palette, colours);
        for (std::size_t k = 0; k < values.size(); ++k) {
            EXPECT_EQ(colours[k], colour_at(palette, position_in({0.1F, 1.7F}, values[k])));
        }
    }
}

TEST(Enlarge, PixelsBecomeSquares) {
    Image image(2, 2);
    image.at(0, 0) = {1, 0, 0};
    image.at(1, 0) = {0, 1, 0};
    image.at(0, 1) = {0, 0, 1};
    image.at(1, 1) = {0.5F, 0.5F, 0};
    const Image large = enlarge(image, 3);
    ASSERT_EQ(large.width, 6);
    ASSERT_EQ(large.height, 6);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) EXPECT_EQ(large.at(x, y), image.at(x / 3, y / 3));
    }
    EXPECT_TRUE(large.alpha.empty());
    EXPECT_EQ(enlarge(image, 1).pixels, image.pixels);
    image.alpha = {0, 0.25F, 0.5F, 1};
    const std::vector<float> alpha = enlarge(image, 2).alpha;
    EXPECT_EQ(alpha, (std::vector<float>{0, 0, 0.25F, 0.25F, 0, 0, 0.25F, 0.25F,  //
                                         0.5F, 0.5F, 1, 1, 0.5F, 0.5F, 1, 1}));
    EXPECT_DEATH(enlarge(image, 0), "factor");
}

}  // namespace
}  // namespace cascade
