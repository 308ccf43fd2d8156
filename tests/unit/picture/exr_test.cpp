// OpenEXR files, read by the library's own reader, which is independent of the interface that
// writes them.
#include "picture/exr.h"

#include "unit/picture/exr_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

namespace cascade {
namespace {

using test::ReadExr;

ReadExr read_back(const std::string& bytes) {
    const auto path = std::filesystem::path(testing::TempDir()) / "cascade.exr";
    std::ofstream(path, std::ios::binary) << bytes;
    ReadExr read = test::read_exr(path);
    std::filesystem::remove(path);
    return read;
}

TEST(Exr, HoldsNumbersOfAnySize) {
    // 37 rows are two blocks and a part of a third.
    const std::int64_t width = 23, height = 37;
    std::vector<float> numbers;
    for (int k = 0; k < width * height; ++k) {
        numbers.push_back(1e6F * std::sin(static_cast<float>(k)) - 3);
    }
    numbers[5] = std::numeric_limits<float>::quiet_NaN();
    const ExrChannel only{"Y", numbers.data(), 1, false};
    const auto bytes = encode_exr(width, height, {&only, 1});
    ASSERT_TRUE(bytes) << bytes.error().message;
    const ReadExr read = read_back(*bytes);
    EXPECT_EQ(read.names, std::vector<std::string>{"Y"});
    EXPECT_TRUE(read.half.empty());
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        if (k == 5) EXPECT_TRUE(std::isnan(read.numbers[0][k]));
        else EXPECT_EQ(read.numbers[0][k], numbers[k]) << k;
    }
}

TEST(Exr, KeepsChannelsApart) {
    const std::int64_t width = 16, height = 16;
    std::vector<float> colours, opacity;
    for (int k = 0; k < 256; ++k) {
        for (int c = 0; c < 3; ++c)
            colours.push_back(static_cast<float>(k) / 256 + static_cast<float>(c));
        opacity.push_back(1 - static_cast<float>(k) / 256);
    }
    const std::vector<ExrChannel> channels = {{"R", colours.data(), 3, true},
                                              {"G", colours.data() + 1, 3, true},
                                              {"B", colours.data() + 2, 3, true},
                                              {"A", opacity.data(), 1, true}};
    const auto bytes = encode_exr(width, height, channels);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(*bytes, *encode_exr(width, height, channels));
    const ReadExr read = read_back(*bytes);
    EXPECT_EQ(read.names, (std::vector<std::string>{"A", "B", "G", "R"}));
    EXPECT_EQ(read.half, read.names);
    for (std::size_t k = 0; k < 256; ++k) {
        EXPECT_FLOAT_EQ(read.numbers[0][k], opacity[k]);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(read.numbers[3 - c][k], colours[3 * k + c], 1e-3);
        }
    }
}

TEST(Exr, MayBeAPixelWide) {
    const float one = 0.25F;
    const ExrChannel only{"Y", &one, 1, true};
    const ReadExr read = read_back(*encode_exr(1, 1, {&only, 1}));
    EXPECT_EQ(read.numbers[0][0], one);
}

}  // namespace
}  // namespace cascade
