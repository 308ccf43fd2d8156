// Palettes: names, monotone lightness, and colours between the stops.
#include "core/palette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>

namespace cascade {
namespace {

/// Relative luminance of an sRGB colour (IEC 61966-2-1).
double luminance(const Colour& colour) {
    const auto linear = [](float value) {
        const double v = static_cast<double>(value);
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

/// CIE 1976 lightness, 0 … 100.
double lightness(const Colour& colour) {
    const double y = luminance(colour);
    return y > 216.0 / 24389.0 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27.0;
}

TEST(Palette, GreyComesFirstAndIsALine) {
    const Palette& grey = palettes().front();
    EXPECT_EQ(grey.name, "grey");
    for (const double position : {0.0, 0.25, 0.5, 0.8125, 1.0}) {
        for (const float channel : colour_at(grey, position)) {
            EXPECT_FLOAT_EQ(channel, static_cast<float>(position));
        }
    }
}

TEST(Palette, NamesAreUniqueAndFound) {
    std::set<std::string_view> names;
    for (const Palette& palette : palettes()) {
        EXPECT_TRUE(names.insert(palette.name).second) << palette.name;
        EXPECT_EQ(find_palette(palette.name), &palette);
        EXPECT_FALSE(palette.description.empty());
        EXPECT_GE(palette.stops.size(), 2U);
    }
    for (const char* name : {"viridis", "magma", "inferno", "plasma", "cividis", "leopard", "tan",
                             "zebra", "giraffe", "coral", "lionfish"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
}

TEST(Palette, UnknownNamesAreNotFound) {
    EXPECT_EQ(find_palette(""), nullptr);
    EXPECT_EQ(find_palette("Grey"), nullptr);
    EXPECT_EQ(find_palette("viridi"), nullptr);
    EXPECT_EQ(find_palette("tan "), nullptr);
}

TEST(Palette, EveryPaletteGoesFromDarkToLight) {
    for (const Palette& palette : palettes()) {
        double last = -1;
        for (int k = 0; k <= 512; ++k) {
            const double now = luminance(colour_at(palette, k / 512.0));
            EXPECT_GT(now, last) << palette.name << " at " << k << " of 512";
            last = now;
        }
        EXPECT_GT(lightness(palette.stops.back()) - lightness(palette.stops.front()), 50)
            << palette.name << " shows too little contrast";
    }
}

TEST(Palette, PerceptualMapsRiseEvenlyInLightness) {
    // Lightness is linear in perceptual maps. They were made in CAM02-UCS, so L* is only nearly
    // linear.
    for (const char* name : {"viridis", "magma", "inferno", "plasma", "cividis"}) {
        const Palette& palette = *find_palette(name);
        const double low = lightness(colour_at(palette, 0));
        const double high = lightness(colour_at(palette, 1));
        for (int k = 0; k <= 32; ++k) {
            const double part = k / 32.0;
            EXPECT_NEAR(lightness(colour_at(palette, part)), low + (high - low) * part, 6)
                << name << " at " << part;
        }
    }
}

TEST(Palette, KnownColoursOfThePerceptualMaps) {
    // The colours 0, 128 and 255 of the published tables of 256 colours, in 8 bits. 0.5 lies
    // between the colours 127 and 128.
    const auto expect = [](const char* name, double position, int red, int green, int blue) {
        const Colour colour = colour_at(*find_palette(name), position);
        EXPECT_NEAR(static_cast<double>(colour[0]) * 255, red, 1.5) << name << " " << position;
        EXPECT_NEAR(static_cast<double>(colour[1]) * 255, green, 1.5) << name << " " << position;
        EXPECT_NEAR(static_cast<double>(colour[2]) * 255, blue, 1.5) << name << " " << position;
    };
    expect("viridis", 0, 0x44, 0x01, 0x54);
    expect("viridis", 0.5, 0x21, 0x90, 0x8c);
    expect("viridis", 1, 0xfd, 0xe7, 0x25);
    expect("magma", 0.5, 0xb6, 0x36, 0x79);
    expect("inferno", 0.5, 0xbc, 0x37, 0x54);
    expect("plasma", 0, 0x0d, 0x08, 0x87);
    expect("plasma", 1, 0xf0, 0xf9, 0x21);
    expect("cividis", 0, 0x00, 0x22, 0x4e);
}

TEST(Palette, StopsAreHitAndJoinedByLines) {
    for (const Palette& palette : palettes()) {
        const auto last = static_cast<double>(palette.stops.size() - 1);
        for (std::size_t k = 0; k + 1 < palette.stops.size(); ++k) {
            const auto place = static_cast<double>(k);
            const Colour at_stop = colour_at(palette, place / last);
            const Colour between = colour_at(palette, (place + 0.25) / last);
            for (std::size_t c = 0; c < 3; ++c) {
                const float from = palette.stops[k][c];
                const float to = palette.stops[k + 1][c];
                EXPECT_NEAR(at_stop[c], from, 1e-6F) << palette.name;
                EXPECT_NEAR(between[c], 0.75F * from + 0.25F * to, 1e-6F) << palette.name;
                EXPECT_GE(from, 0.0F);
                EXPECT_LE(from, 1.0F);
            }
        }
    }
}

TEST(Palette, PositionsAreClampedAndNanIsMagenta) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const Palette& palette : palettes()) {
        EXPECT_EQ(colour_at(palette, -0.5), palette.stops.front());
        EXPECT_EQ(colour_at(palette, -infinity), palette.stops.front());
        EXPECT_EQ(colour_at(palette, 1), palette.stops.back());
        EXPECT_EQ(colour_at(palette, 7), palette.stops.back());
        EXPECT_EQ(colour_at(palette, infinity), palette.stops.back());
        const double nan = std::numeric_limits<double>::quiet_NaN();
        EXPECT_EQ(colour_at(palette, nan), (Colour{1, 0, 1}));
    }
}

TEST(Palette, MayBeColoursOfOnesOwn) {
    const Palette* const own = find_palette("#000000 #8040ff  #fff");
    ASSERT_NE(own, nullptr);
    ASSERT_EQ(own->stops.size(), 3u);
    EXPECT_EQ(own->stops[0], (Colour{0, 0, 0}));
    EXPECT_EQ(own->stops[2], (Colour{1, 1, 1}));
    EXPECT_FLOAT_EQ(colour_at(*own, 0.5)[0], 128.0F / 255);
    EXPECT_FLOAT_EQ(colour_at(*own, 0.75)[1], (64.0F / 255 + 1) / 2);
    EXPECT_EQ(find_palette("#000000 #8040ff  #fff"), own);
    for (const char* word : {"#000000", "#8040ff", "#1b2a49"}) {
        ASSERT_TRUE(find_colour(word)) << word;
        EXPECT_EQ(hexadecimal(*find_colour(word)), word);
    }
    EXPECT_EQ(hexadecimal(*find_colour("#FA0")), "#ffaa00");
    for (const char* word : {"", "#", "white", "8040ff", "#8040fg", "#8040f", "#-10000"}) {
        EXPECT_FALSE(find_colour(word)) << word;
    }
    std::string many = "#000";
    for (int k = 0; k < 63; ++k) many += " #fff";
    EXPECT_NE(find_palette(many), nullptr);
    EXPECT_EQ(find_palette(many + " #fff"), nullptr);
    for (const char* text :
         {"#", "#000", "#000 #ff", "#000 white", "#000000 #gggggg", "#000,#fff"}) {
        EXPECT_EQ(find_palette(text), nullptr) << text;
    }
}

TEST(Palette, TheSpecificationListsThem) {
    std::ifstream file(CASCADE_SOURCE_DIR "/spec/pictures.md");
    std::string spec((std::istreambuf_iterator<char>(file)), {});
    ASSERT_FALSE(spec.empty());
    std::size_t last = 0;
    for (const Palette& palette : palettes()) {
        const std::string row = "| `" + std::string(palette.name) + "` | " +
                                std::to_string(palette.stops.size()) + " | " +
                                std::string(palette.description) + " |\n";
        const std::size_t place = spec.find(row);
        ASSERT_NE(place, std::string::npos) << row;
        EXPECT_GT(place, last) << "the order differs at " << palette.name;
        last = place;
    }
}

}  // namespace
}  // namespace cascade
