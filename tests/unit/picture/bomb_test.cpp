// Small PNG files that declare large sizes or decompress to much data are refused before they take
// much memory.
#include "picture/grey_picture.h"
#include "picture/image.h"
#include "tests/support/limited_memory.h"
#include "tests/unit/picture/png_chunks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t room = std::uint64_t{64} << 20;

/// A picture with a header and almost no data.
std::string promising(std::uint32_t width, std::uint32_t height, const std::string& form) {
    return test::assemble({{"IHDR", test::big_endian(width) + test::big_endian(height) + form},
                           {"IDAT", test::deflated(std::string(10, '\0'))},
                           {"IEND", ""}});
}

std::string pixels_of(const std::string& file) {
    return test::in_limited_memory(room, [&] {
        const auto picture = parse_grey_picture(file);
        return picture ? "a picture" : picture.error().message;
    });
}

TEST(PngBomb, SizesAreLookedAtBeforeAnythingIsAllocated) {
    const std::string rgb_interlaced("\x08\x02\0\0\x01", 5), rgba16("\x10\x06\0\0\0", 5);
    EXPECT_THAT(pixels_of(promising(1073741829, 5, rgb_interlaced)), HasSubstr("at most 67108864"));
    EXPECT_THAT(pixels_of(promising(5, 1073741829, rgba16)), HasSubstr("at most 67108864"));
    EXPECT_THAT(pixels_of(promising(8192, 8192, rgba16)), HasSubstr("too short for its pixels"));
    EXPECT_THAT(pixels_of(promising(67108864, 1, rgba16)), HasSubstr("too short for its pixels"));
    // One bit for each pixel takes little space in the file, but much memory.
    EXPECT_THAT(pixels_of(promising(8192, 8192, std::string("\x01\0\0\0\0", 5))),
                HasSubstr("too short for its pixels"));
}

TEST(PngBomb, WhatStandsBesideThePixelsIsNotInflated) {
    const std::string nul(1, '\0');
    const std::string bomb = test::deflated(std::string(std::size_t{256} << 20, '\0'));
    for (const test::Chunk& chunk : {test::Chunk{"zTXt", "Key" + nul + nul + bomb},
                                     test::Chunk{"iCCP", "Key" + nul + nul + bomb}}) {
        EXPECT_EQ(pixels_of(test::assemble(test::tiny_png({chunk, chunk, chunk}))), "a picture")
            << chunk.name;
    }
}

TEST(PngBomb, AllTextsTogetherAreBounded) {
    const std::string nul(1, '\0');
    const std::string bomb = test::deflated(std::string(longest_png_text - 1, ' '));
    std::vector<test::Chunk> texts;
    for (int k = 0; k < 64; ++k) {
        texts.push_back({"zTXt", "Key " + std::to_string(k) + nul + nul + bomb});
    }
    const std::string file = test::assemble(test::tiny_png(texts));
    EXPECT_THAT(test::in_limited_memory(room,
                                        [&] {
                                            const auto read = parse_png_texts(file);
                                            return read ? "texts" : read.error().message;
                                        }),
                HasSubstr("the PNG file is damaged"));
}

}  // namespace
}  // namespace cascade
