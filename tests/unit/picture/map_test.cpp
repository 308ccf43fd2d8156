// Maps of runs: the positions of pictures, and the look of an empty position.
#include "picture/map.h"

#include "plain_colours.h"

#include <gtest/gtest.h>

#include <vector>

namespace cascade {
namespace {

using test::blue;
using test::green;
using test::red;

/// The position of the first pixel of a colour in reading order, or −1, and the number of its
/// pixels.
struct Place {
    std::int64_t x = -1, y = -1, count = 0;
};

Place place_of(const Image& image, Colour colour) {
    Place place;
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            if (image.at(x, y) != colour) continue;
            if (place.count++ == 0) place = {x, y, 1};
        }
    }
    return place;
}

std::int64_t ink_right_of(const Image& image, std::int64_t x) {
    std::int64_t count = 0;
    for (std::int64_t j = 0; j < image.height; ++j) {
        for (std::int64_t i = x; i < image.width; ++i) count += image.at(i, j)[0] < 0.2F ? 1 : 0;
    }
    return count;
}

TEST(Map, TheFirstRowIsTheLowest) {
    const std::vector<MapTile> tiles = {{Image(64, 64, red), ""},
                                        {Image(64, 64, green), ""},
                                        {Image(64, 64, blue), ""},
                                        {Image(), "not finite"}};
    const Image map = make_map(tiles, {"feed", {"0.02", "0.04"}}, {"kill", {"0.05", "0.06"}});
    const Place first = place_of(map, red), right = place_of(map, green);
    const Place above = place_of(map, blue);
    // 64 pixels become 128, and each picture is complete.
    EXPECT_EQ(first.count, 128 * 128);
    EXPECT_EQ(above.count, 128 * 128);
    EXPECT_EQ(right.y, first.y);
    EXPECT_GT(right.x, first.x + 127);
    EXPECT_EQ(above.x, first.x);
    EXPECT_LT(above.y + 127, first.y);
    // The empty position has a frame and the reason.
    EXPECT_EQ(map.at(right.x - 1, above.y - 1), map.at(first.x - 1, first.y - 1));
    EXPECT_NE(map.at(right.x, above.y), map.at(0, 0));
    EXPECT_GT(ink_right_of(map, right.x + 5), 50);
}

TEST(Map, AnAxisWithoutNameHasNoLabels) {
    const std::vector<MapTile> tiles = {{Image(128, 128, red), ""}};
    const Image bare = make_map(tiles, {"", {""}}, {"", {""}});
    EXPECT_EQ(ink_right_of(bare, 0), 0);
    EXPECT_EQ(bare.width, 128 + 2 * 16);
    EXPECT_EQ(bare.height, 128 + 2 * 16);
    const Image named = make_map(tiles, {"ka", {"1/80"}}, {"", {""}});
    EXPECT_GT(ink_right_of(named, 0), 20);
    EXPECT_EQ(named.width, bare.width);
    EXPECT_GT(named.height, bare.height);
}

TEST(Map, LinesAreBandsAndAllMayBeEmpty) {
    const std::vector<MapTile> lines = {{Image(128, 1, red), ""}, {Image(128, 1, blue), ""}};
    const Image map = make_map(lines, {"", {""}}, {"a", {"1", "2"}});
    EXPECT_EQ(place_of(map, red).count, 128 * 24);
    const std::vector<MapTile> nothing = {{Image(), "not finite"}, {Image(), ""}};
    const Image empty = make_map(nothing,
                                 {"a very long name of a parameter, longer than its tiles "
                                  "are wide, but not a reason to fail",
                                  {"1", "2"}},
                                 {"", {""}});
    EXPECT_GT(empty.width, 2 * 128);
}

TEST(Map, LongLabelsStayWithinTheirTiles) {
    const std::vector<MapTile> tiles(3, MapTile{Image(128, 8, green), ""});
    const std::string value(80, 'w');
    const Image map = make_map(tiles, {"a", {value, value, value}}, {"", {""}});
    EXPECT_EQ(map.width, 3 * 128 + 2 * 6 + 2 * 16);
}

}  // namespace
}  // namespace cascade
