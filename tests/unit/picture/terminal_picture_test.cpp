// Pictures of half-block characters.
#include "picture/image.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cascade {
namespace {

std::int64_t count_of(const std::string& text, const std::string& word) {
    std::int64_t count = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

TEST(HalfBlocks, UpperPixelInFrontLowerBehind) {
    Image image(1, 2);
    image.at(0, 0) = {1, 0, 0};
    image.at(0, 1) = {0, 0.5F, 1};
    EXPECT_EQ(half_blocks(image, 80), "\x1b[38;2;255;0;0m\x1b[48;2;0;128;255m▀\x1b[0m\n");
}

TEST(HalfBlocks, AColourIsSaidOnceAsLongAsItStays) {
    EXPECT_EQ(half_blocks(Image(3, 2, {0, 0, 0}), 80),
              "\x1b[38;2;0;0;0m\x1b[48;2;0;0;0m▀▀▀\x1b[0m\n");
}

TEST(PlainCharacters, RunFromDarkToLight) {
    Image image(4, 3, {0, 0, 0});
    for (std::int64_t y = 0; y < 3; ++y) image.at(1, y) = {0.5F, 0.5F, 0.5F};
    for (std::int64_t y = 0; y < 3; ++y) image.at(2, y) = {1, 1, 1};
    image.at(3, 1) = {1, 1, 1};
    EXPECT_EQ(plain_characters(image, 80), " +@-\n +@-\n");
    EXPECT_EQ(plain_characters(Image(9, 9), 3), "@@@\n@@@\n");
    EXPECT_EQ(plain_characters(Image(), 3), "");
}

TEST(HalfBlocks, EveryLineIsResetAndStartsAfresh) {
    const std::string line = "\x1b[38;2;255;255;255m\x1b[48;2;255;255;255m▀▀\x1b[0m\n";
    EXPECT_EQ(half_blocks(Image(2, 4), 80), line + line);
}

TEST(HalfBlocks, AnOddLastRowLeavesTheGround) {
    EXPECT_EQ(half_blocks(Image(2, 1, {0, 0, 0}), 80), "\x1b[38;2;0;0;0m▀▀\x1b[0m\n");
}

TEST(HalfBlocks, TransparentPixelsLeaveTheGround) {
    Image image(4, 2, {0, 0, 0});
    image.at(0, 0) = image.at(0, 1) = transparent;
    image.at(2, 0) = transparent;
    image.at(3, 1) = transparent;
    EXPECT_EQ(half_blocks(image, 80), " \x1b[38;2;0;0;0m\x1b[48;2;0;0;0m▀\x1b[49m▄▀\x1b[0m\n");
}

TEST(HalfBlocks, PixelsOfLessThanHalfTheOpacityLeaveTheGround) {
    Image image(2, 2, {0, 0, 0});
    image.alpha = {0.4F, 1, 0.3F, 0.5F};
    EXPECT_EQ(half_blocks(image, 80), " \x1b[38;2;0;0;0m\x1b[48;2;0;0;0m▀\x1b[0m\n");
    image.pixels.assign(4, {1, 1, 1});
    EXPECT_EQ(plain_characters(image, 80), " @\n");
}

TEST(HalfBlocks, AveragesAreOfWhatIsSeen) {
    Image image(4, 2, {0, 0, 0});
    image.at(0, 0) = image.at(1, 0) = image.at(0, 1) = transparent;
    image.at(3, 1) = transparent;
    EXPECT_EQ(half_blocks(image, 2), " \x1b[38;2;0;0;0m▀\x1b[0m\n");
}

TEST(HalfBlocks, WiderPicturesAreAveraged) {
    Image image(4, 4);
    for (std::int64_t y = 0; y < 4; ++y) {
        for (std::int64_t x = 0; x < 4; ++x) {
            const float value = x < 2 ? static_cast<float>((x + y) % 2) : 0.2F;
            image.at(x, y) = {value, value, value};
        }
    }
    EXPECT_EQ(half_blocks(image, 2),
              "\x1b[38;2;128;128;128m\x1b[48;2;128;128;128m▀"
              "\x1b[38;2;51;51;51m\x1b[48;2;51;51;51m▀\x1b[0m\n");
}

TEST(HalfBlocks, PartsOfPixelsCountByTheirArea) {
    // Three pixels become two, each of which gets half of the middle pixel: (1 + 0)/1.5 and (0 +
    // 0.3)/1.5.
    Image image(3, 3);
    for (std::int64_t y = 0; y < 3; ++y) {
        image.at(0, y) = {1, 1, 1};
        image.at(1, y) = {0, 0, 0};
        image.at(2, y) = {0.3F, 0.3F, 0.3F};
    }
    const std::string text = half_blocks(image, 2);
    EXPECT_NE(text.find("38;2;170;170;170m"), std::string::npos) << text;
    EXPECT_NE(text.find("38;2;51;51;51m"), std::string::npos) << text;
}

TEST(HalfBlocks, ProportionsAndWidthAreKept) {
    const std::string text = half_blocks(Image(200, 100), 60);
    // 60 × 30 pixels, and two rows of pixels in each line.
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 15);
    EXPECT_EQ(count_of(text, "▀"), 60 * 15);
    EXPECT_EQ(count_of(half_blocks(Image(10'000, 1), 7), "▀"), 7);
    EXPECT_EQ(count_of(half_blocks(Image(10, 10), 80), "▀"), 50);  // Nothing is enlarged.
}

TEST(HalfBlocks, NothingToShow) { EXPECT_EQ(half_blocks(Image(), 80), ""); }

TEST(HalfBlocks, ATerminalHasColumns) {
    EXPECT_DEATH((void)half_blocks(Image(1, 1), 0), "columns");
}

}  // namespace
}  // namespace cascade
