// Conversion between sRGB values and linear light.
#include "picture/srgb.h"

#include "tests/support/not_finite.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace cascade {
namespace {

using test::infinity;
using test::nan;

TEST(Srgb, LevelsComeBack) {
    for (unsigned level = 0; level < 256; ++level) {
        const float stored = static_cast<float>(level) / 255;
        EXPECT_EQ(level_of(stored_of(light_of(stored)), 255), level);
    }
    EXPECT_EQ(light_of(0.0F), 0);
    EXPECT_EQ(light_of(1.0F), 1);
    EXPECT_EQ(stored_of(1.0F), 1);
    EXPECT_NEAR(light_of(0.5F), 0.214041F, 1e-6F);  // The standard's formula.
    EXPECT_NEAR(light_of(0.04F), 0.04F / 12.92F, 1e-9F);
}

/// The formulas of the standard with std::pow, at values that reach all parts of the tables.
TEST(Srgb, PowersAreThoseOfTheLibrary) {
    for (std::uint32_t bits = std::bit_cast<std::uint32_t>(0.04046F);
         bits <= std::bit_cast<std::uint32_t>(1.5F); bits += 97) {
        const auto stored = std::bit_cast<float>(bits);
        EXPECT_EQ(light_of(stored), steady_power((stored + 0.055F) / 1.055F, 2.4)) << stored;
    }
    for (std::uint32_t bits = std::bit_cast<std::uint32_t>(0.0031309F);
         bits < std::bit_cast<std::uint32_t>(1.0F); bits += 97) {
        const auto light = std::bit_cast<float>(bits);
        EXPECT_EQ(stored_of(light), 1.055F * steady_power(light, 1 / 2.4) - 0.055F) << light;
    }
}

TEST(Srgb, ManyColoursAreConvertedAsEach) {
    for (const float beyond : {1.0F, 1.5F, -0.5F, nan}) {
        std::vector<Colour> colours;
        for (int k = 0; k < 10000; ++k) {
            const float stored = static_cast<float>(k) / 9999;
            colours.push_back({stored, stored * stored, 1 - stored});
        }
        colours[77][1] = beyond;
        std::vector<Colour> lights = colours, stored = colours;
        convert_to_light(lights);
        convert_to_stored(stored);
        for (std::size_t k = 0; k < colours.size(); ++k) {
            EXPECT_EQ(lights[k], light_of(colours[k])) << k;
            EXPECT_EQ(stored[k], stored_of(colours[k])) << k;
        }
    }
}

TEST(Srgb, WhatIsNoAmountIsClamped) {
    for (const float none : {nan, -1.0F, -infinity}) {
        EXPECT_EQ(light_of(none), 0);
        EXPECT_EQ(stored_of(none), 0);
        EXPECT_EQ(level_of(none, 65535), 0u);
    }
    EXPECT_EQ(stored_of(7.0F), 1);
    EXPECT_EQ(level_of(infinity, 65535), 65535u);
}

}  // namespace
}  // namespace cascade
