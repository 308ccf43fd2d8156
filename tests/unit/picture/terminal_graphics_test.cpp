// Pictures in the protocols of terminals that show pixels.
#include "picture/terminal_graphics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string decoded(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    for (std::size_t at = 0; at + 3 < text.size(); at += 4) {
        std::size_t word = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t digit = digits.find(text[at + k]);
            word = word << 6 | (digit == std::string::npos ? 0 : digit);
        }
        const std::size_t count = text[at + 2] == '=' ? 1 : text[at + 3] == '=' ? 2 : 3;
        for (std::size_t k = 0; k < count; ++k) {
            bytes += static_cast<char>(word >> (16 - 8 * k) & 255);
        }
    }
    return bytes;
}

/// The PNG in the sequences of kitty's protocol, each of which has at most 4096 digits.
std::string png_in(std::string text) {
    std::string digits;
    while (!text.empty()) {
        EXPECT_THAT(text, StartsWith("\x1b_G"));
        const std::size_t data = text.find(';') + 1, end = text.find("\x1b\\");
        if (end == std::string::npos) return "";
        EXPECT_LE(end - data, 4096U);
        const bool is_last = end + 2 == text.size();
        EXPECT_THAT(text.substr(0, data), HasSubstr(is_last ? "m=0;" : "m=1;"));
        digits += text.substr(data, end - data);
        text.erase(0, end + 2);
    }
    return decoded(digits);
}

std::string png_of(const Image& image) {
    return *encode_png(image, PngDepth::eight, {}, PngMeaning::colours, PngEffort::fast);
}

/// A picture in which neighbours differ, so that its file is large.
Image noisy(std::int64_t width, std::int64_t height) {
    Image image(width, height);
    std::uint32_t state = 1;
    for (Colour& pixel : image.pixels) {
        for (float& channel : pixel) {
            state = state * 1664525 + 1013904223;
            channel = static_cast<float>(state >> 16) / 65536.0F;
        }
    }
    return image;
}

TEST(KittyPicture, IsThePngInPieces) {
    for (const Image& image : {Image(1, 1), Image(3, 2, {0, 0.5F, 1}), noisy(101, 67)}) {
        EXPECT_EQ(png_in(kitty_picture(image)), png_of(image));
    }
}

TEST(KittyPicture, MovesNoCursorAndAsksForNoAnswer) {
    EXPECT_THAT(kitty_picture(Image(1, 1)), StartsWith("\x1b_Gf=100,a=T,C=1,q=2,m=0;"));
    EXPECT_THAT(kitty_picture(Image(1, 1), 7), StartsWith("\x1b_Gf=100,a=T,C=1,q=2,i=7,m=0;"));
    EXPECT_EQ(kitty_picture(Image()), "");
}

TEST(SixelPicture, HasBandsOfSixRows) {
    Image image(5, 7, {0, 0, 0});
    image.at(1, 1) = {1, 1, 1};
    image.at(4, 6) = transparent;
    const std::string text =
        "\x1bP0;1;0q\"1;1;5;7#0;2;0;0;0#1;2;100;100;100"
        "#0~|~~~$#1?A$-"
        "#0!4@$-"
        "\x1b\\";
    EXPECT_EQ(sixel_picture(image), text);
    // Pixels are either opaque or transparent.
    image.at(4, 6) = {1, 0, 1};
    image.alpha.assign(image.pixels.size(), 0.5F);
    image.alpha_at(4, 6) = 0.49F;
    EXPECT_EQ(sixel_picture(image), text);
}

TEST(ReducedPictures, KeepTheirOpacity) {
    Image image(4, 2, {1, 0, 0});
    image.alpha = {1, 0, 0, 0, 1, 0.5F, 0, 0};
    image.at(1, 1) = {0, 1, 0};
    image.at(3, 0) = transparent;
    const Image small = reduce(image, 2);
    ASSERT_EQ(small.alpha.size(), 2U);
    EXPECT_FLOAT_EQ(small.alpha[0], 2.5F / 4);
    EXPECT_EQ(small.alpha[1], 0);
    // Each pixel has its opacity as weight.
    EXPECT_FLOAT_EQ(small.at(0, 0)[0], 2 / 2.5F);
    EXPECT_FLOAT_EQ(small.at(0, 0)[1], 0.5F / 2.5F);
    EXPECT_TRUE(is_transparent(small.at(1, 0)));
}

TEST(SixelPicture, HasAtMost256Colours) {
    const std::string text = sixel_picture(noisy(64, 64));
    int colours = 0;
    for (auto at = text.find(";2;"); at != std::string::npos; at = text.find(";2;", at + 1)) {
        ++colours;
    }
    EXPECT_GT(colours, 100);
    EXPECT_LE(colours, 256);
    EXPECT_THAT(text, EndsWith("\x1b\\"));
}

}  // namespace
}  // namespace cascade
