// Text in the corner of a picture.
#include "picture/caption.h"

#include "picture/lettering.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

const Colour ground = {0, 0.5F, 0};

/// The number of pixels of a colour in a part of the picture.
int pixels_of(const Image& image, const Colour& colour, std::int64_t right, std::int64_t top) {
    int count = 0;
    for (std::int64_t y = top; y < image.height; ++y) {
        for (std::int64_t x = 0; x < right; ++x) count += image.at(x, y) == colour ? 1 : 0;
    }
    return count;
}

TEST(Captions, LieInTheLowerLeftCorner) {
    Image image(100, 40, ground);
    draw_caption(image, "step = 20");
    // Nine characters of six columns, without the last gap, and of nine rows, with a margin of
    // three pixels.
    const std::int64_t width = 9 * 6 - 1 + 6, height = 15;
    EXPECT_EQ(pixels_of(image, ground, width, 40 - height), 0);
    EXPECT_EQ(pixels_of(image, ground, 100, 0), 100 * 40 - width * height);
    EXPECT_GT(pixels_of(image, sheet_ink, width, 40 - height), 60);
    EXPECT_EQ(pixels_of(image, sheet_ink, 100, 0), pixels_of(image, sheet_ink, width, 40 - height));
}

TEST(Captions, AreOpaque) {
    Image image(100, 40, transparent);
    image.alpha.assign(image.pixels.size(), 0);
    draw_caption(image, "t");
    EXPECT_EQ(image.opacity(1, 38), 1.0F);
    EXPECT_EQ(image.opacity(90, 2), 0.0F);
}

TEST(Captions, GrowWithThePicture) {
    Image image(720, 60, ground);
    draw_caption(image, "t");
    EXPECT_EQ(pixels_of(image, ground, 720, 0), 720 * 60 - (5 + 6) * 3 * 15 * 3);
}

TEST(Captions, AreCutWhereTheyAreTooWide) {
    Image image(40, 20, ground);
    draw_caption(image, "mean(u over domain) = 0.25");
    EXPECT_EQ(pixels_of(image, ground, 40, 5), 0);
    EXPECT_EQ(pixels_of(image, ground, 40, 0), 40 * 5);
}

TEST(Captions, NeedRoom) {
    EXPECT_TRUE(has_room_for_caption(30, 15));
    EXPECT_FALSE(has_room_for_caption(29, 15));
    EXPECT_FALSE(has_room_for_caption(30, 14));
    EXPECT_FALSE(has_room_for_caption(480, 29));
    EXPECT_TRUE(has_room_for_caption(480, 30));
}

}  // namespace
}  // namespace cascade
