// Images with another number of pixels.
#include "picture/resized_image.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

Image grey(std::int64_t width, std::int64_t height, const std::vector<float>& values) {
    Image image(width, height);
    for (std::size_t k = 0; k < values.size(); ++k)
        image.pixels[k] = {values[k], values[k], values[k]};
    return image;
}

TEST(ResizedImage, PixelsAreMeansOfWhatTheyCover) {
    const Image image = grey(3, 2, {0, 0.5F, 1, 1, 0.5F, 0});
    const Image half = resized(image, 2, 1);
    // The left pixel covers the first column and half of the second.
    EXPECT_FLOAT_EQ(half.at(0, 0)[0], 0.5F);
    const Image wide = resized(image, 6, 2);
    for (std::int64_t x = 0; x < 6; ++x) EXPECT_EQ(wide.at(x, 1), image.at(x / 2, 1));
    const Image narrow = resized(image, 2, 2);
    EXPECT_FLOAT_EQ(narrow.at(0, 0)[0], 0.5F / 3);
    EXPECT_FLOAT_EQ(narrow.at(1, 0)[0], 2.5F / 3);
    EXPECT_TRUE(narrow.alpha.empty());
}

TEST(ResizedImage, TransparentPixelsDoNotDarkenOthers) {
    Image image = grey(2, 1, {0.8F, 0});
    image.at(1, 0) = transparent;
    const Image one = resized(image, 1, 1);
    EXPECT_FLOAT_EQ(one.at(0, 0)[0], 0.8F);
    EXPECT_FLOAT_EQ(one.opacity(0, 0), 0.5F);
    EXPECT_TRUE(is_transparent(resized(image, 4, 1).at(3, 0)));
}

TEST(ResizedImage, TheMiddleIsSurroundedByNothing) {
    const Image image = grey(2, 2, {0, 0.25F, 0.5F, 1});
    const Image large = in_the_middle(image, 5, 4);
    EXPECT_EQ(large.at(1, 1), image.at(0, 0));
    EXPECT_EQ(large.at(2, 2), image.at(1, 1));
    int opaque = 0;
    for (const Colour& pixel : large.pixels) opaque += is_transparent(pixel) ? 0 : 1;
    EXPECT_EQ(opaque, 4);
}

}  // namespace
}  // namespace cascade
