// Painting many cells at once, in used memory, or directly into a file gives the same as painting
// cell by cell.
#include "picture/image.h"

#include "picture/srgb.h"
#include "tests/support/not_finite.h"
#include "tests/unit/picture/png_chunks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// Waves that exceed the range from 0 to 1 on both sides.
Field painted_waves(std::int64_t width, std::int64_t height) {
    Field field{PlaneLayout(Grid{width, height})};
    for (std::int64_t j = 0; j < height; ++j) {
        for (std::int64_t i = 0; i < width; ++i) {
            const auto x = static_cast<double>(i), y = static_cast<double>(j);
            field.at(i, j) = static_cast<float>(0.5 + 0.6 * std::sin(x / 7 + y * y / 90));
        }
    }
    return field;
}

/// painted_waves() with non-finite values of all kinds, and −0, in some cells.
Field waves_with_gaps(std::int64_t width, std::int64_t height) {
    Field field = painted_waves(width, height);
    const std::array gaps{test::nan, test::infinity, -test::infinity, -0.0F};
    for (std::int64_t j = 0; j < height; ++j) {
        for (std::int64_t i = j % 5; i < width; i += 11) {
            field.at(i, j) = gaps[static_cast<std::size_t>(i + j) % gaps.size()];
        }
    }
    return field;
}

std::vector<const Palette*> palettes_to_paint_with() {
    std::vector<const Palette*> found;
    for (const Palette& palette : palettes()) found.push_back(&palette);
    for (const char* own : {"#ddd #222", "#000 #888 #fff", "#f00 #00f", "#123456 #123456"}) {
        found.push_back(find_palette(own));
    }
    return found;
}

constexpr ValueRange painted_ranges[] = {{0, 1},           {1, 0},      {0.5F, 0.5F},
                                         {-3e38F, 3e38F},  {0, 1e-40F}, {0, test::infinity},
                                         {test::nan, 1.0F}};

bool have_same_bits(const std::vector<Colour>& one, const std::vector<Colour>& other) {
    return one.size() == other.size() &&
           std::memcmp(one.data(), other.data(), one.size() * sizeof(Colour)) == 0;
}

/// Widths below and above the number of cells that are painted at once.
TEST(Painting, OfManyCellsGivesTheColoursOfEach) {
    for (const Palette* palette : palettes_to_paint_with()) {
        for (const ValueRange range : painted_ranges) {
            for (const std::int64_t width : {1, 255, 256, 259, 600}) {
                const Field field = waves_with_gaps(width, 3);
                Image each(width, 3);
                for (std::int64_t j = 0; j < 3; ++j) {
                    for (std::int64_t i = 0; i < width; ++i) {
                        each.at(i, j) = colour_at(*palette, position_in(range, field.at(i, j)));
                    }
                }
                EXPECT_TRUE(have_same_bits(paint(field, range, *palette).pixels, each.pixels))
                    << palette->name << " from " << range.low << " to " << range.high;
            }
        }
    }
}

TEST(Painting, InTheMemoryOfAnEarlierImageLeavesNothingOfIt) {
    const Palette& leopard = *find_palette("leopard");
    for (const std::int64_t side : {20, 40, 60}) {
        Image earlier(40, 40, transparent);
        earlier.alpha.assign(40 * 40, 0.5F);
        const Colour* const memory = earlier.pixels.data();
        const Field field = waves_with_gaps(side, side);
        const Image fresh = paint(field, {0, 1}, leopard);
        Image image = paint(field, {0, 1}, leopard, std::move(earlier));
        EXPECT_EQ(image.pixels.data() == memory, side <= 40);
        EXPECT_EQ(image.width, side);
        EXPECT_EQ(image.height, side);
        EXPECT_TRUE(image.alpha.empty());
        EXPECT_TRUE(have_same_bits(image.pixels, fresh.pixels));
        const Image colours = paint(field, field, field);
        EXPECT_TRUE(
            have_same_bits(paint(field, field, field, std::move(image)).pixels, colours.pixels));
    }
}

TEST(Painting, StraightIntoAFileGivesTheFileOfItsImage) {
    const Field with_gaps = waves_with_gaps(70, 20), whole = painted_waves(300, 20);
    for (const Palette* palette : palettes_to_paint_with()) {
        for (const ValueRange range : painted_ranges) {
            for (const PngDepth depth : {PngDepth::eight, PngDepth::sixteen}) {
                for (const Field* field : {&with_gaps, &whole}) {
                    const auto of_image =
                        encode_png(paint(*field, range, *palette), depth, {{"Script", "s"}});
                    const auto straight =
                        encode_png(Painting{*field, range, *palette}, depth, {{"Script", "s"}});
                    ASSERT_TRUE(of_image && straight);
                    EXPECT_EQ(*straight, *of_image)
                        << palette->name << " from " << range.low << " to " << range.high;
                }
            }
        }
    }
}

TEST(Painting, StraightIntoAFileFailsAsThatOfAnImageDoes) {
    const Field field = painted_waves(3, 3);
    const Palette& grey = *find_palette("grey");
    const PngTexts texts{{"Script", std::string("a\0b", 3)}};
    const auto of_image = encode_png(paint(field, {0, 1}, grey), PngDepth::eight, texts);
    const auto straight = encode_png(Painting{field, {0, 1}, grey}, PngDepth::eight, texts);
    ASSERT_FALSE(of_image || straight);
    EXPECT_EQ(straight.error().message, of_image.error().message);
}

/// Each value gets the nearest level. A value in the middle between two gets the upper one.
TEST(Levels, AreTheNearestOnes) {
    for (const unsigned highest : {255U, 65535U}) {
        for (unsigned k = 0; k <= 3 * highest; ++k) {
            const float value = static_cast<float>(k) / static_cast<float>(2 * highest);
            const double exact = std::min(static_cast<double>(value), 1.0) * highest;
            EXPECT_EQ(level_of(value, highest), static_cast<unsigned>(std::floor(exact + 0.5)));
        }
        EXPECT_EQ(level_of(-0.5F, highest), 0U);
        EXPECT_EQ(level_of(-test::infinity, highest), 0U);
        EXPECT_EQ(level_of(3e38F, highest), highest);
    }
}

/// A row that needs more channels may follow any number of rows that need fewer.
TEST(EncodePng, TakesTheChannelsThatItsLastRowsNeed) {
    for (const PngDepth depth : {PngDepth::eight, PngDepth::sixteen}) {
        for (const bool has_colour : {false, true}) {
            for (const bool has_hole : {false, true}) {
                Image image(5, 4, {0.2F, 0.2F, 0.2F});
                if (has_hole) image.at(4, 2) = transparent;
                if (has_colour) image.at(2, 3) = {1, 0, 0};
                const unsigned highest = depth == PngDepth::eight ? 255 : 65535;
                std::vector<unsigned> levels;
                for (const Colour& pixel : image.pixels) {
                    const bool is_hole = is_transparent(pixel);
                    for (std::size_t c = 0; c < (has_colour ? 3U : 1U); ++c) {
                        levels.push_back(is_hole ? highest : level_of(pixel[c], highest));
                    }
                    if (has_hole) levels.push_back(is_hole ? 0 : highest);
                }
                const auto file = encode_png(image, depth, {});
                ASSERT_TRUE(file);
                const test::DecodedPng png = test::decode(*file);
                EXPECT_EQ(png.colour_type, (has_colour ? 2 : 0) + (has_hole ? 4 : 0));
                EXPECT_EQ(png.samples, levels);
            }
        }
    }
}

/// The filters of section 9 of the PNG specification, for a row and the row above.
std::string filtered_by_definition(int number, const std::string& row, const std::string& above,
                                   std::size_t pixel) {
    std::string out;
    for (std::size_t k = 0; k < row.size(); ++k) {
        const auto byte = [&](const std::string& of, bool is_left) {
            if (is_left && k < pixel) return 0;
            return static_cast<int>(static_cast<unsigned char>(of[is_left ? k - pixel : k]));
        };
        const int left = byte(row, true), up = byte(above, false), corner = byte(above, true);
        const int predictions[] = {0, left, up, (left + up) / 2,
                                   static_cast<int>(test::paeth(left, up, corner))};
        out += static_cast<char>(byte(row, false) - predictions[number]);
    }
    return out;
}

TEST(EncodePng, EachRowHasTheFilterWhoseDifferencesAreSmallest) {
    std::uint32_t state = 7;
    Image image(300, 40);
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            state = state * 1664525U + 1013904223U;
            const auto noise = static_cast<double>(state >> 8) / (1U << 24);
            const auto column = static_cast<double>(x), row = static_cast<double>(y);
            const double smooth = std::sin(column / 9) * std::cos(row * column / 700);
            const double value = 0.5 + 0.4 * smooth + 0.02 * static_cast<double>(y % 7) * noise;
            image.at(x, y) = {static_cast<float>(value), 0.3F, static_cast<float>(noise)};
        }
    }
    const auto file = encode_png(image, PngDepth::eight, {});
    ASSERT_TRUE(file);
    const std::size_t count = 3 * 300, pixel = 3;
    std::string data;
    for (const test::Chunk& chunk : test::take_apart(*file)) {
        if (chunk.name == "IDAT") data += chunk.data;
    }
    const std::string raw = test::inflated(data, (count + 1) * 40);
    const std::string bytes = test::unfiltered(raw, count, pixel);
    std::string above(count, '\0');
    std::array<int, 5> used{};
    for (std::size_t y = 0; y < 40; ++y) {
        const std::string row = bytes.substr(y * count, count);
        std::array<int, 5> sizes{};
        for (int number = 0; number < 5; ++number) {
            for (const char difference : filtered_by_definition(number, row, above, pixel)) {
                sizes[static_cast<std::size_t>(number)] +=
                    std::abs(static_cast<int>(static_cast<signed char>(difference)));
            }
        }
        const auto best = std::min_element(sizes.begin(), sizes.end()) - sizes.begin();
        EXPECT_EQ(raw[y * (count + 1)], best) << "row " << y;
        EXPECT_EQ(raw.substr(y * (count + 1) + 1, count),
                  filtered_by_definition(static_cast<int>(best), row, above, pixel));
        ++used[static_cast<std::size_t>(best)];
        above = row;
    }
    EXPECT_GE(std::count_if(used.begin(), used.end(), [](int rows) { return rows > 0; }), 2);
}

}  // namespace
}  // namespace cascade
