// Damaged files of all kinds give a failure or a value, but never a crash. These tests are most
// useful with sanitizers.
#include "picture/image.h"
#include "picture/npy.h"
#include "picture/pixel_file.h"
#include "tests/unit/picture/png_chunks.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace cascade {
namespace {

std::string valid_npy() { return encode_npy(Field(PlaneLayout(Grid{3, 2}))); }

std::string valid_png() {
    const PngTexts texts{{"Script", std::string(2000, 's')}, {"Seed", "1"}, {"Version", "0.1.0"}};
    return encode_png(Image(5, 4, {0.2F, 0.5F, 0.8F}), PngDepth::sixteen, texts).value_or("");
}

/// Expects a failure with a reason, or a consistent value.
void expect_sound_npy(const std::string& bytes) {
    const Result<NpyArray> array = parse_npy(bytes);
    if (!array) {
        EXPECT_FALSE(array.error().message.empty());
        return;
    }
    EXPECT_EQ(static_cast<std::size_t>(array->rows * array->columns), array->values.size());
    EXPECT_LE(array->values.size(), bytes.size());
}

void expect_sound_png(const std::string& bytes) {
    const Result<PngTexts> texts = parse_png_texts(bytes);
    EXPECT_TRUE(texts || !texts.error().message.empty());
}

using Expectation = void (*)(const std::string& bytes);

void cut_everywhere(const std::string& file, Expectation expect_sound) {
    for (std::size_t size = 0; size <= file.size(); ++size) expect_sound(file.substr(0, size));
}

void flip_every_bit(const std::string& file, Expectation expect_sound) {
    for (std::size_t k = 0; k < file.size() * 8; ++k) {
        std::string changed = file;
        changed[k / 8] = static_cast<char>(changed[k / 8] ^ (1 << k % 8));
        expect_sound(changed);
    }
}

/// Replaces, deletes, doubles and swaps random parts.
std::string shaken(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : random() % limit; };
    const std::size_t changes = 1 + below(6);
    for (std::size_t change = 0; change < changes; ++change) {
        const std::size_t at = below(bytes.size());
        const std::size_t size = below(16);
        switch (below(4)) {
            case 0: bytes.erase(at, size); break;
            case 1: bytes.insert(at, bytes.substr(below(bytes.size()), size)); break;
            case 2: bytes.insert(at, size, static_cast<char>(random())); break;
            default:
                if (at < bytes.size()) bytes[at] = static_cast<char>(random());
        }
    }
    return bytes;
}

TEST(HostileNpy, CutFlippedAndShaken) {
    const std::string file = valid_npy();
    ASSERT_TRUE(parse_npy(file));
    cut_everywhere(file, expect_sound_npy);
    flip_every_bit(file, expect_sound_npy);
    std::mt19937 random(1);
    for (int round = 0; round < 20'000; ++round) expect_sound_npy(shaken(file, random));
}

TEST(HostileNpy, ShakenDictionaries) {
    const std::string dictionary =
        "{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 3, 4L), }";
    std::mt19937 random(2);
    for (int round = 0; round < 20'000; ++round) {
        const std::string changed = shaken(dictionary, random);
        std::string file("\x93NUMPY\x01\x00", 8);
        file += static_cast<char>(changed.size() & 0xff);
        file += static_cast<char>(changed.size() >> 8);
        expect_sound_npy(file + changed);
    }
}

std::string valid_pixels() { return print_pixel_file({3, 2, {0, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F}}); }

void expect_sound_pixels(const std::string& bytes) {
    const Result<GreyPicture> picture = parse_pixel_file(bytes);
    if (!picture) {
        EXPECT_FALSE(picture.error().message.empty());
        return;
    }
    EXPECT_EQ(static_cast<std::size_t>(picture->width * picture->height), picture->values.size());
    EXPECT_LE(picture->values.size() * sizeof(float), bytes.size());
}

TEST(HostilePixels, ComeBackOrAreRefused) {
    const std::string file = valid_pixels();
    const auto picture = parse_pixel_file(file);
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->width, 3);
    EXPECT_EQ(picture->height, 2);
    EXPECT_EQ(print_pixel_file(*picture), file);
    for (std::size_t size = 0; size < file.size(); ++size) {
        EXPECT_FALSE(parse_pixel_file(file.substr(0, size))) << size;
    }
    EXPECT_FALSE(parse_pixel_file(file + "0"));
    EXPECT_FALSE(parse_pixel_file(file + "0000"));
    const std::string red_file = print_pixel_file({1, 1, {0.5F}}, PictureChannel::red);
    EXPECT_FALSE(parse_pixel_file(red_file));
    ASSERT_TRUE(parse_pixel_file(file + red_file, PictureChannel::red));
    EXPECT_EQ(parse_pixel_file(file + red_file, PictureChannel::red)->values.size(), 1u);
    EXPECT_EQ(parse_pixel_file(file + red_file)->values.size(), 6u);
    flip_every_bit(file, expect_sound_pixels);
    std::mt19937 random(6);
    for (int round = 0; round < 20'000; ++round) expect_sound_pixels(shaken(file, random));
}

TEST(HostilePixels, AbsurdSidesAreRefused) {
    const std::string file = valid_pixels();
    const std::int64_t sides[] = {-6, -1, 0, 1, 6, 7, std::int64_t{1} << 32, INT64_MIN, INT64_MAX};
    for (const std::int64_t width : sides) {
        for (const std::int64_t height : sides) {
            std::string changed = file;
            std::memcpy(changed.data() + 16, &width, sizeof width);
            std::memcpy(changed.data() + 24, &height, sizeof height);
            const bool fits = (width == 1 && height == 6) || (width == 6 && height == 1);
            EXPECT_EQ(parse_pixel_file(changed).has_value(), fits) << width << " " << height;
        }
    }
}

TEST(HostilePng, CutFlippedAndShaken) {
    const std::string file = valid_png();
    ASSERT_TRUE(parse_png_texts(file));
    cut_everywhere(file, expect_sound_png);
    flip_every_bit(file, expect_sound_png);
    std::mt19937 random(3);
    for (int round = 0; round < 5'000; ++round) expect_sound_png(shaken(file, random));
}

TEST(HostilePng, ShakenChunksWithRightChecksums) {
    // Wrong checksums stop a reader early, so these files have right ones.
    const std::string nul(1, '\0');
    std::vector<test::Chunk> chunks = test::take_apart(valid_png());
    ASSERT_GE(chunks.size(), 5U);
    chunks.insert(chunks.end() - 1, {"zTXt", "Note" + nul + nul + test::deflated("some words")});
    chunks.insert(chunks.end() - 1, {"tEXt", "Title" + nul + "caf\xe9"});
    ASSERT_TRUE(parse_png_texts(test::assemble(chunks)));
    std::mt19937 random(4);
    for (int round = 0; round < 20'000; ++round) {
        std::vector<test::Chunk> changed = chunks;
        const std::size_t changes = 1 + random() % 3;
        for (std::size_t change = 0; change < changes && !changed.empty(); ++change) {
            const std::size_t k = random() % changed.size();
            switch (random() % 5) {
                case 0: changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(k)); break;
                case 1: changed.push_back(changed[k]); break;
                case 2: std::swap(changed[k], changed[random() % changed.size()]); break;
                default: changed[k].data = shaken(changed[k].data, random);
            }
        }
        expect_sound_png(test::assemble(changed));
    }
}

}  // namespace
}  // namespace cascade
