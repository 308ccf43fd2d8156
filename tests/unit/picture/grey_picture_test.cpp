// Pictures as numbers: every kind of pixel, refused files, and resizing.
#include "picture/grey_picture.h"
#include "picture/image.h"
#include "tests/unit/picture/png_chunks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

using test::Chunk;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;

/// A PNG without row filters. `rows` are the packed bytes of each row.
std::string png(std::uint32_t width, const std::vector<std::string>& rows, char depth, char type,
                const std::vector<Chunk>& before = {}) {
    std::string raw;
    for (const std::string& row : rows) raw += std::string(1, '\0') + row;
    std::vector<Chunk> chunks{
        {"IHDR", test::big_endian(width) +
                     test::big_endian(static_cast<std::uint32_t>(rows.size())) + depth + type +
                     std::string(3, '\0')}};
    chunks.insert(chunks.end(), before.begin(), before.end());
    chunks.push_back({"IDAT", test::deflated(raw)});
    chunks.push_back({"IEND", ""});
    return test::assemble(chunks);
}

std::vector<float> values_of(const std::string& bytes) {
    const Result<GreyPicture> picture = parse_grey_picture(bytes);
    EXPECT_TRUE(picture) << (picture ? "" : picture.error().message);
    return picture ? picture->values : std::vector<float>{};
}

std::string fault_of(const std::string& bytes) {
    const Result<GreyPicture> picture = parse_grey_picture(bytes);
    return picture ? "no fault" : picture.error().message;
}

std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
}

TEST(GreyPicture, ChannelsAreAsTheyAreStored) {
    const auto channels = [](const std::string& file) {
        std::vector<float> values;
        for (const PictureChannel channel : {PictureChannel::red, PictureChannel::green,
                                             PictureChannel::blue, PictureChannel::alpha}) {
            const auto picture = parse_grey_picture(file, channel);
            EXPECT_TRUE(picture);
            if (picture) values.push_back(picture->values.at(0));
        }
        return values;
    };
    const auto near = [](float value) { return FloatNear(value, 1e-6F); };
    EXPECT_THAT(channels(png(1, {bytes({51, 102, 153, 0})}, 8, 6)),
                ElementsAre(near(0.2F), near(0.4F), near(0.6F), 0));
    EXPECT_THAT(channels(png(1, {bytes({51, 102, 153})}, 8, 2)),
                ElementsAre(near(0.2F), near(0.4F), near(0.6F), 1));
    EXPECT_THAT(channels(png(1, {bytes({51, 204})}, 8, 4)),
                ElementsAre(near(0.2F), near(0.2F), near(0.2F), near(0.8F)));
    EXPECT_THAT(channels(png(1, {bytes({0x33, 0x33})}, 16, 0)),
                ElementsAre(near(0.2F), near(0.2F), near(0.2F), 1));
    EXPECT_THAT(channels(png(1, {bytes({0})}, 8, 3, {{"PLTE", bytes({255, 51, 0})}})),
                ElementsAre(1, near(0.2F), 0, 1));
}

TEST(GreyPicture, GreyOfEveryDepth) {
    EXPECT_THAT(values_of(png(2, {bytes({0x80}), bytes({0x40})}, 1, 0)), ElementsAre(1, 0, 0, 1));
    EXPECT_THAT(values_of(png(3, {bytes({0x1b})}, 2, 0)),
                ElementsAre(0, FloatNear(1 / 3.0F, 1e-6F), FloatNear(2 / 3.0F, 1e-6F)));
    EXPECT_THAT(values_of(png(2, {bytes({0xf3})}, 4, 0)), ElementsAre(1, FloatNear(0.2F, 1e-6F)));
    EXPECT_THAT(values_of(png(3, {bytes({0, 51, 255})}, 8, 0)),
                ElementsAre(0, FloatNear(0.2F, 1e-6F), 1));
    EXPECT_THAT(values_of(png(2, {bytes({0x12, 0x34, 0xff, 0xff})}, 16, 0)),
                ElementsAre(FloatNear(4660.0F / 65535.0F, 1e-7F), 1));
}

TEST(GreyPicture, ColoursBecomeTheirLightness) {
    const std::vector<float> values =
        values_of(png(4, {bytes({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255})}, 8, 2));
    EXPECT_THAT(values, ElementsAre(FloatNear(0.2126F, 1e-6F), FloatNear(0.7152F, 1e-6F),
                                    FloatNear(0.0722F, 1e-6F), FloatNear(1, 1e-6F)));
    const Chunk palette{"PLTE", bytes({0, 0, 0, 255, 0, 0, 255, 255, 255})};
    EXPECT_THAT(values_of(png(3, {bytes({2, 1, 0})}, 8, 3, {palette})),
                ElementsAre(FloatNear(1, 1e-6F), FloatNear(0.2126F, 1e-6F), 0));
}

TEST(GreyPicture, WhatIsTransparentIsWhite) {
    EXPECT_THAT(values_of(png(3, {bytes({0, 0, 0, 255, 0, 51})}, 8, 4)),
                ElementsAre(1, 0, FloatNear(0.8F, 1e-6F)));
    EXPECT_THAT(values_of(png(2, {bytes({0, 0, 0, 0, 0, 0, 0, 255})}, 8, 6)), ElementsAre(1, 0));
    const Chunk palette{"PLTE", bytes({0, 0, 0, 0, 0, 0})};
    EXPECT_THAT(values_of(png(2, {bytes({0, 1})}, 8, 3, {palette, {"tRNS", bytes({0})}})),
                ElementsAre(1, 0));
}

TEST(GreyPicture, WhatIsWrittenIsRead) {
    Image image(5, 3);
    for (std::int64_t k = 0; k < 15; ++k) {
        const float grey = static_cast<float>(k) / 14.0F;
        image.pixels[static_cast<std::size_t>(k)] = {grey, grey, grey};
    }
    const auto values = values_of(*encode_png(image, PngDepth::sixteen, {}));
    for (std::size_t k = 0; k < 15; ++k)
        EXPECT_NEAR(values[k], static_cast<float>(k) / 14.0F, 1e-5);
}

TEST(GreyPicture, DamageIsTold) {
    const std::string whole = png(64, std::vector<std::string>(64, std::string(64, 'x')), 8, 0);
    EXPECT_EQ(fault_of(whole), "no fault");
    EXPECT_EQ(fault_of("GIF89a"), "it is not a PNG file");
    EXPECT_EQ(fault_of(""), "it is not a PNG file");
    for (std::size_t size = 8; size < whole.size(); ++size) {
        EXPECT_THAT(fault_of(whole.substr(0, size)), HasSubstr("cut off or damaged")) << size;
    }
    for (std::size_t k = 8; k < whole.size(); ++k) {
        std::string wrong = whole;
        wrong[k] = static_cast<char>(wrong[k] ^ 0x55);
        EXPECT_NE(fault_of(wrong), "it is not a PNG file") << k;  // Reading must not crash, either.
    }
}

TEST(GreyPicture, HugeOnesAreRefused) {
    const auto of_size = [](std::uint32_t width, std::uint32_t height) {
        return test::assemble({{"IHDR", test::big_endian(width) + test::big_endian(height) +
                                            std::string("\x08\0\0\0\0", 5)},
                               {"IDAT", test::deflated(std::string(100, '\0'))},
                               {"IEND", ""}});
    };
    EXPECT_EQ(fault_of(of_size(100000, 100000)),
              "it has 100000 × 100000 pixels, and at most 67108864 are read");
    EXPECT_THAT(fault_of(of_size(2147483647, 2147483647)), HasSubstr("pixels, and at most"));
    EXPECT_THAT(fault_of(of_size(8000, 8000)), HasSubstr("too short for its pixels"));
}

TEST(GreyPicture, ShrinksToMeansAndGrowsLinearly) {
    const GreyPicture picture{4, 2, {0, 1, 2, 3, 4, 5, 6, 7}};
    EXPECT_THAT(resized(picture, 4, 2).values, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(resized(picture, 2, 1).values, ElementsAre(2.5, 4.5));
    EXPECT_THAT(resized(picture, 1, 1).values, ElementsAre(3.5));
    const GreyPicture three{3, 1, {0, 3, 6}};
    EXPECT_THAT(resized(three, 2, 1).values, ElementsAre(1, 5)) << "two thirds and one third";
    const GreyPicture two{2, 1, {0, 1}};
    EXPECT_THAT(resized(two, 4, 2).values, ElementsAre(0, 0.25, 0.75, 1, 0, 0.25, 0.75, 1));
    const GreyPicture one{1, 1, {0.5F}};
    EXPECT_THAT(resized(one, 2, 2).values, ElementsAre(0.5, 0.5, 0.5, 0.5));
}

TEST(GreyPicture, IsTheSameInEverySlice) {
    const Field field = to_field(GreyPicture{2, 2, {0, 1, 2, 3}}, Grid{2, 2, {}, 3});
    for (std::int64_t k = 0; k < 3; ++k) {
        EXPECT_EQ(field.at(1, 0, k), 1);
        EXPECT_EQ(field.at(0, 1, k), 2);
    }
}

}  // namespace
}  // namespace cascade
