// PNG files: pixels, depths, text chunks, and refused files.
#include "picture/image.h"
#include "tests/unit/picture/png_chunks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>

namespace cascade {
namespace {

using test::Chunk;
using test::DecodedPng;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string encoded(const Image& image, PngDepth depth, const PngTexts& texts = {}) {
    const Result<std::string> bytes = encode_png(image, depth, texts);
    EXPECT_TRUE(bytes) << (bytes ? "" : bytes.error().message);
    return bytes.value_or("");
}

Image coloured() {
    Image image(2, 1);
    image.at(0, 0) = {1, 0.5F, 0};
    image.at(1, 0) = {0.2F, 0.4F, 0.6F};
    return image;
}

/// The data of the only chunk of a name, or "missing" if there is not exactly one.
std::string only_chunk(const std::string& file, const std::string& name) {
    std::string data = "missing";
    int count = 0;
    for (const Chunk& chunk : test::take_apart(file)) {
        if (chunk.name != name) continue;
        data = chunk.data;
        ++count;
    }
    EXPECT_EQ(count, 1) << name;
    return data;
}

TEST(EncodePng, EightBitColours) {
    const DecodedPng png = test::decode(encoded(coloured(), PngDepth::eight));
    EXPECT_EQ(png.width, 2U);
    EXPECT_EQ(png.height, 1U);
    EXPECT_EQ(png.depth, 8);
    EXPECT_EQ(png.colour_type, 2);
    EXPECT_THAT(png.samples, ElementsAre(255, 128, 0, 51, 102, 153));
}

TEST(EncodePng, SixteenBitColours) {
    const DecodedPng png = test::decode(encoded(coloured(), PngDepth::sixteen));
    EXPECT_EQ(png.depth, 16);
    EXPECT_EQ(png.colour_type, 2);
    // 0.2F, 0.4F and 0.6F are 13107, 26214 and 39321 of 65535 to the nearest level.
    EXPECT_THAT(png.samples, ElementsAre(65535, 32768, 0, 13107, 26214, 39321));
}

TEST(EncodePng, WhatIsTransparentIsWhiteBehindAlpha) {
    Image image = coloured();
    image.at(1, 0) = transparent;
    const DecodedPng colours = test::decode(encoded(image, PngDepth::eight));
    EXPECT_EQ(colours.colour_type, 6);
    EXPECT_THAT(colours.samples, ElementsAre(255, 128, 0, 255, 255, 255, 255, 0));
    image.at(0, 0) = {0.2F, 0.2F, 0.2F};
    const DecodedPng grey = test::decode(encoded(image, PngDepth::sixteen));
    EXPECT_EQ(grey.colour_type, 4);
    EXPECT_THAT(grey.samples, ElementsAre(13107, 65535, 65535, 0));
}

TEST(EncodePng, OpacityStandsBesideColoursAsTheyAre) {
    Image image = coloured();
    image.alpha = {0.2F, 1};
    const DecodedPng png = test::decode(encoded(image, PngDepth::eight));
    EXPECT_EQ(png.colour_type, 6);
    EXPECT_THAT(png.samples, ElementsAre(255, 128, 0, 51, 51, 102, 153, 255));
    EXPECT_EQ(image.over({0, 0, 1}, 1, 0), image.at(1, 0));
    EXPECT_FLOAT_EQ(image.over({0, 0, 1}, 0, 0)[0], 0.2F);
    EXPECT_FLOAT_EQ(image.over({0, 0, 1}, 0, 0)[2], 0.8F);
}

TEST(EncodePng, GreyPicturesAreGreyscale) {
    Image image(3, 2);
    for (int k = 0; k < 6; ++k) {
        const float value = static_cast<float>(k) / 5;
        image.pixels[static_cast<std::size_t>(k)] = {value, value, value};
    }
    const DecodedPng eight = test::decode(encoded(image, PngDepth::eight));
    EXPECT_EQ(eight.colour_type, 0);
    EXPECT_THAT(eight.samples, ElementsAre(0, 51, 102, 153, 204, 255));
    const DecodedPng sixteen = test::decode(encoded(image, PngDepth::sixteen));
    EXPECT_EQ(sixteen.colour_type, 0);
    EXPECT_EQ(sixteen.depth, 16);
    EXPECT_THAT(sixteen.samples, ElementsAre(0, 13107, 26214, 39321, 52428, 65535));
}

TEST(EncodePng, OneColouredPixelMakesItColoured) {
    Image image(40, 40, {0.5F, 0.5F, 0.5F});
    image.at(39, 39) = {0.5F, 0.5F, 0.6F};
    EXPECT_EQ(test::decode(encoded(image, PngDepth::eight)).colour_type, 2);
}

TEST(EncodePng, ValuesBeyondTheRangeAreClamped) {
    Image image(2, 1);
    image.at(0, 0) = {-3, 2, std::numeric_limits<float>::quiet_NaN()};
    image.at(1, 0) = {std::numeric_limits<float>::infinity(), -0.0F, 1};
    EXPECT_THAT(test::decode(encoded(image, PngDepth::eight)).samples,
                ElementsAre(0, 255, 0, 255, 0, 255));
}

/// A picture with smooth and rough parts, so that every row filter is likely to be chosen.
struct Sample {
    Image image;
    std::vector<unsigned> levels;  ///< The levels as in a file.
};
Sample sample(std::int64_t width, std::int64_t height, unsigned highest, bool is_grey,
              bool has_alpha) {
    Sample made{Image(width, height), {}};
    std::uint32_t state = 1;
    for (std::int64_t y = 0; y < height; ++y) {
        for (std::int64_t x = 0; x < width; ++x) {
            const bool is_seen = !has_alpha || (x + y) % 3 > 0;
            Colour& pixel = made.image.at(x, y);
            unsigned level = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                state = state * 1664525U + 1013904223U;
                const auto smooth = static_cast<unsigned>(x * 2 + y + 20 * static_cast<int>(c));
                if (c == 0 || !is_grey) level = (y < height / 2 ? smooth : state >> 15) & highest;
                pixel[c] = static_cast<float>(level) / static_cast<float>(highest);
                if (c == 0 || !is_grey) made.levels.push_back(is_seen ? level : highest);
            }
            if (has_alpha) made.levels.push_back(is_seen ? highest : 0);
            if (!is_seen) pixel = transparent;
        }
    }
    return made;
}

TEST(EncodePng, LargerPicturesKeepEveryPixelInEveryFormat) {
    for (const PngDepth depth : {PngDepth::eight, PngDepth::sixteen}) {
        for (const bool is_grey : {false, true}) {
            for (const bool has_alpha : {false, true}) {
                const unsigned highest = depth == PngDepth::eight ? 255 : 65535;
                const auto [image, levels] = sample(97, 61, highest, is_grey, has_alpha);
                for (const PngEffort effort : {PngEffort::small, PngEffort::fast}) {
                    const auto file = encode_png(image, depth, {}, PngMeaning::colours, effort);
                    ASSERT_TRUE(file);
                    const DecodedPng png = test::decode(*file);
                    EXPECT_EQ(png.colour_type, (is_grey ? 0 : 2) + (has_alpha ? 4 : 0));
                    EXPECT_EQ(png.samples, levels);
                }
            }
        }
    }
}

TEST(EncodePng, MuchDataIsInSeveralChunks) {
    const auto [image, levels] = sample(1000, 900, 255, false, false);
    const std::string file = encoded(image, PngDepth::eight);
    int count = 0;
    for (const Chunk& chunk : test::take_apart(file)) {
        if (chunk.name == "IDAT") ++count;
        EXPECT_LE(chunk.data.size(), std::size_t{1} << 20);
    }
    EXPECT_EQ(count, 2);
    EXPECT_EQ(test::decode(file).samples, levels);
}

TEST(EncodePng, EffortMakesSmallerFiles) {
    Image rings(300, 200);
    for (std::int64_t y = 0; y < rings.height; ++y) {
        for (std::int64_t x = 0; x < rings.width; ++x) {
            const bool is_dark = (x * x + y * y) / 500 % 2 == 0;
            rings.at(x, y) = is_dark ? Colour{0.2F, 0.1F, 0} : Colour{1, 0.9F, 0.7F};
        }
    }
    const auto fast = encode_png(rings, PngDepth::eight, {}, PngMeaning::colours, PngEffort::fast);
    EXPECT_LT(encoded(rings, PngDepth::eight).size(), fast->size());
}

TEST(EncodePng, SaysThatColoursAreSrgb) {
    EXPECT_EQ(only_chunk(encoded(coloured(), PngDepth::eight), "sRGB").size(), 1U);
}

TEST(EncodePng, TextsStandBeforeThePictureAsUtf8) {
    const std::string script = "# ein Jaguar – größer\na: 4\n";
    const std::string file = encoded(coloured(), PngDepth::eight, {{"Script", script}});
    // Keyword, NUL, not compressed, method 0, no language, no translated keyword, text.
    EXPECT_EQ(only_chunk(file, "iTXt"), "Script" + std::string("\0\0\0\0\0", 5) + script);
    bool text_seen = false;
    for (const Chunk& chunk : test::take_apart(file)) {
        text_seen = text_seen || chunk.name == "iTXt";
        EXPECT_TRUE(text_seen || chunk.name != "IDAT");
    }
}

TEST(EncodePng, LongTextsAreCompressed) {
    const std::string script(100'000, 'x');
    const std::string file = encoded(coloured(), PngDepth::eight, {{"Script", script}});
    const std::string data = only_chunk(file, "iTXt");
    ASSERT_LT(data.size(), 2000U);
    EXPECT_EQ(data.substr(0, 11), "Script" + std::string("\0\1\0\0\0", 5));
    EXPECT_EQ(test::inflated(data.substr(11), script.size()), script);
}

TEST(EncodePng, EqualPicturesGiveEqualFiles) {
    const PngTexts texts{{"Seed", "1"}, {"Script", std::string(3000, 'y')}};
    EXPECT_EQ(encoded(coloured(), PngDepth::eight, texts),
              encoded(coloured(), PngDepth::eight, texts));
}

TEST(EncodePng, SizesThatNoPngCanHave) {
    Image image;
    EXPECT_EQ(encode_png(image, PngDepth::eight, {}).error().message, "the picture has no pixels");
    image.width = std::int64_t{1} << 31;
    image.height = 1;
    EXPECT_THAT(encode_png(image, PngDepth::eight, {}).error().message,
                HasSubstr("2147483648 × 1 pixels is too large"));
    image.width = 3;
    image.height = -1;
    EXPECT_FALSE(encode_png(image, PngDepth::eight, {}));
}

TEST(EncodePng, TextsThatAPngCannotHold) {
    const std::string with_nul("a\0b", 3);
    EXPECT_THAT(encode_png(coloured(), PngDepth::eight, {{"Script", with_nul}}).error().message,
                HasSubstr("'Script' that goes with the picture has a NUL byte"));
    const std::string long_text(longest_png_text + 1, ' ');
    EXPECT_THAT(encode_png(coloured(), PngDepth::eight, {{"Script", long_text}}).error().message,
                HasSubstr("longer than 16777216 bytes"));
    EXPECT_DEATH((void)encode_png(coloured(), PngDepth::eight, {{"", "x"}}), "keywords");
    EXPECT_DEATH((void)encode_png(coloured(), PngDepth::eight, {{" a", "x"}}), "keywords");
}

TEST(PngTexts, ComeBackAsTheyWere) {
    const PngTexts texts{{"Software", "Cascade 0.1.0"},
                         {"Script", "a: 4 # “größer”, 斑\n"},
                         {"Long script", std::string(200'000, 'z') + "é"},
                         {"Empty", ""}};
    for (const PngDepth depth : {PngDepth::eight, PngDepth::sixteen}) {
        const Result<PngTexts> back = parse_png_texts(encoded(coloured(), depth, texts));
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(*back, texts);
    }
}

TEST(PngTexts, TheLongestTextComesBack) {
    std::string text(longest_png_text, 'q');
    const Result<PngTexts> back =
        parse_png_texts(encoded(coloured(), PngDepth::eight, {{"Script", text}}));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(back->at("Script") == text);
}

TEST(PngTexts, AllThreeKindsOnBothSidesOfThePicture) {
    const std::string nul(1, '\0');
    const std::string file = test::assemble(test::tiny_png(
        {{"tEXt", "Title" + nul + "caf\xe9"},
         {"zTXt", "Comment" + nul + nul +
                      test::deflated("\xfc"
                                     "ber")}},
        {{"iTXt", "Script" + nul + "\1" + nul + "en" + nul + nul + test::deflated("Größe: 4")},
         {"tEXt", "Title" + nul + "second"}}));
    const Result<PngTexts> texts = parse_png_texts(file);
    ASSERT_TRUE(texts) << texts.error().message;
    const PngTexts expected{{"Title", "café"}, {"Comment", "über"}, {"Script", "Größe: 4"}};
    EXPECT_EQ(*texts, expected);
}

TEST(PngTexts, ThePictureInSeveralChunksIsSteppedOver) {
    const std::string data = test::deflated(std::string(2, '\0'));
    std::vector<Chunk> chunks = test::tiny_png({}, {{"tEXt", std::string("Key\0value", 9)}});
    chunks[1].data = data.substr(0, 3);
    chunks.insert(chunks.begin() + 2, {"IDAT", data.substr(3)});
    const Result<PngTexts> texts = parse_png_texts(test::assemble(chunks));
    ASSERT_TRUE(texts) << texts.error().message;
    EXPECT_EQ(texts->at("Key"), "value");
}

TEST(PngTexts, OddChunksOfOtherKindsDoNotHideTheScript) {
    const std::string nul(1, '\0');
    const Result<PngTexts> texts = parse_png_texts(test::assemble(test::tiny_png(
        {{"iCCP", "broken"}, {"gAMA", ""}, {"prVt", "what"}, {"tEXt", "Key" + nul + "value"}})));
    ASSERT_TRUE(texts) << texts.error().message;
    EXPECT_EQ(texts->size(), 1U);
}

TEST(PngTexts, NoPng) {
    for (const std::string bytes : {"", "\x89PNG", "a: 4\nb: 5\n", "GIF89a..........."}) {
        const Result<PngTexts> texts = parse_png_texts(bytes);
        ASSERT_FALSE(texts);
        EXPECT_EQ(texts.error().message, "it is not a PNG file");
    }
}

TEST(PngTexts, DamageIsNoticed) {
    const std::string file = encoded(coloured(), PngDepth::eight, {{"Script", "iterations: 4"}});
    const auto expect_damaged = [](const std::string& bytes) {
        const Result<PngTexts> texts = parse_png_texts(bytes);
        ASSERT_FALSE(texts);
        EXPECT_THAT(texts.error().message, HasSubstr("damaged"));
    };
    for (std::size_t size = 8; size < file.size(); ++size) expect_damaged(file.substr(0, size));
    std::string changed = file;
    changed[file.find("iterations")] = 'I';  // Only the checksum reveals this change.
    expect_damaged(changed);
}

TEST(PngTexts, ChunksInTheWrongPlace) {
    std::vector<Chunk> chunks = test::tiny_png();
    std::swap(chunks[0], chunks[1]);
    EXPECT_FALSE(parse_png_texts(test::assemble(chunks)));
    std::swap(chunks[0], chunks[1]);
    chunks.insert(chunks.begin(), chunks[0]);
    EXPECT_FALSE(parse_png_texts(test::assemble(chunks)));
    EXPECT_FALSE(parse_png_texts(test::assemble({{"IEND", ""}})));
}

TEST(PngTexts, ATextThatSwellsBeyondTheLimitIsRefused) {
    const std::string nul(1, '\0');
    const std::string bomb = test::deflated(std::string(longest_png_text * 3, '\0'));
    ASSERT_LT(bomb.size(), 100'000U);
    for (const Chunk& chunk : {Chunk{"zTXt", "Script" + nul + nul + bomb},
                               Chunk{"iTXt", "Script" + nul + "\1" + nul + nul + nul + bomb}}) {
        EXPECT_FALSE(parse_png_texts(test::assemble(test::tiny_png({chunk})))) << chunk.name;
    }
}

TEST(PngTexts, ThousandsOfTextsAreBounded) {
    std::vector<Chunk> many;
    for (int k = 0; k < 5000; ++k) {
        many.push_back({"tEXt", "Key " + std::to_string(k) + std::string(1, '\0') + "value"});
    }
    const Result<PngTexts> texts = parse_png_texts(test::assemble(test::tiny_png(many)));
    ASSERT_TRUE(texts) << texts.error().message;
    EXPECT_EQ(texts->size(), 64U);
}

class PngFile : public ::testing::Test {
protected:
    void SetUp() override {
        const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  ("cascade_png_" + name + "_" + std::to_string(getpid()));
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_;
};

TEST_F(PngFile, IsReplacedWhole) {
    const std::filesystem::path path = folder_ / "picture.png";
    std::ofstream(path) << "what was here before";
    const Result<void> written = write_png(path, coloured(), PngDepth::eight, {{"Seed", "7"}});
    ASSERT_TRUE(written) << written.error().message;
    const Result<PngTexts> texts = read_png_texts(path);
    ASSERT_TRUE(texts) << texts.error().message;
    EXPECT_EQ(texts->at("Seed"), "7");
    // No other file is left in the folder.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(PngFile, FailuresNameTheFile) {
    const std::filesystem::path missing = folder_ / "no" / "picture.png";
    EXPECT_THAT(write_png(missing, coloured(), PngDepth::eight, {}).error().message,
                HasSubstr("no/picture.png"));
    EXPECT_THAT(write_png(folder_ / "a.png", Image(), PngDepth::eight, {}).error().message,
                HasSubstr("a.png': the picture has no pixels"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
    EXPECT_THAT(read_png_texts(missing).error().message, HasSubstr("no/picture.png"));
    EXPECT_FALSE(read_png_texts(folder_));
    std::ofstream(folder_ / "text.png") << "no picture";
    EXPECT_THAT(read_png_texts(folder_ / "text.png").error().message,
                HasSubstr("text.png': it is not a PNG file"));
}

}  // namespace
}  // namespace cascade
