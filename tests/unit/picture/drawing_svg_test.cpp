// Images in SVG files.
#include "core/base64.h"
#include "picture/drawing.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

using testing::HasSubstr;

/// The file of an image that fills 40 × 20 units.
std::string svg_of(const Image& image) {
    Drawing drawing{40, 20, {}};
    drawing.add(DrawnImage{{0, 0}, 40, 20, image});
    return as_svg(drawing).value_or("");
}

std::string embedded(const Image& image) {
    return "base64," + base64(encode_png(image, PngDepth::eight, {}).value_or("")) + "\"";
}

TEST(DrawingSvg, PixelsBecomeSquaresOfPixels) {
    Image image(4, 2, {1, 0, 0});
    image.at(1, 0) = {0, 1, 0};
    image.alpha.assign(8, 0.5F);
    EXPECT_THAT(svg_of(image), HasSubstr(embedded(enlarge(image, 20))));
}

TEST(DrawingSvg, SmallPixelsStayAndOneThatCrossesTheImageDoesNotCount) {
    Image fine(80, 40, {1, 0, 0});
    fine.at(3, 3) = {0, 0, 1};
    EXPECT_THAT(svg_of(fine), HasSubstr(embedded(fine)));
    const Image bar(1, 40, {0, 1, 0});
    EXPECT_THAT(svg_of(bar), HasSubstr(embedded(bar)));
}

}  // namespace
}  // namespace cascade
