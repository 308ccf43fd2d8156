// Plots: their texts, and the positions of their colours.
#include "analysis/dispersion_plot.h"
#include "analysis/map_plot.h"
#include "tests/unit/analysis/closed_forms.h"

#include <algorithm>

namespace cascade::test {
namespace {

using analysis::Stability;

std::size_t pixels_like(const Image& image, const Colour& colour) {
    return static_cast<std::size_t>(
        std::count_if(image.pixels.begin(), image.pixels.end(), [&](const Colour& pixel) {
            return std::abs(pixel[0] - colour[0]) + std::abs(pixel[1] - colour[1]) +
                       std::abs(pixel[2] - colour[2]) <
                   0.01F;
        }));
}

TEST(Plots, OfADispersionRelationNameTheFastestWave) {
    const auto analysed = analyse("stage s: brusselator { }");
    const Drawing drawing = analysis::plot_dispersion(*analysed.analysis);
    const auto svg = as_svg(drawing);
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("brusselator, stage 's': Turing"), std::string::npos);
    EXPECT_NE(svg->find(">9.573 cells</text>"), std::string::npos);
    EXPECT_NE(svg->find("real part"), std::string::npos);
    // Standing waves have no imaginary part.
    EXPECT_EQ(svg->find("imaginary part"), std::string::npos);
    const Image image = as_image(drawing, 2);
    EXPECT_EQ(image.width, 1280);
    EXPECT_GT(pixels_like(image, {0.13F, 0.36F, 0.64F}), 1000U);   // The curve.
    EXPECT_GT(pixels_like(image, {0.87F, 0.93F, 0.98F}), 50000U);  // The band.
}

TEST(Plots, OfOscillationsHaveAnImaginaryPart) {
    const auto analysed =
        analyse("stage s: brusselator { feed: 1; decay: 2.2; diff_u: 1; diff_v: 1 }");
    const auto svg = as_svg(analysis::plot_dispersion(*analysed.analysis));
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("imaginary part"), std::string::npos);
}

TEST(Plots, OfMapsGrowUpwards) {
    analysis::ParameterMap map{{ItemId(0), 0, 1}, {ItemId(1), 0, 1}, 2, {}};
    map.classes = {Stability::stable, Stability::stable, Stability::turing, std::nullopt};
    const Drawing drawing = analysis::plot_map(map, {"title", "across", "up", {0.5, 0.5}});
    const Image image = as_image(drawing, 1);
    // The upper left quarter of the box is blue, the lower left quarter nearly white.
    EXPECT_NEAR(image.at(150, 100)[0], 0.34F, 0.01F);
    EXPECT_NEAR(image.at(150, 450)[0], 0.97F, 0.01F);
    EXPECT_NEAR(image.at(550, 100)[0], 0.80F, 0.01F);
    const auto svg = as_svg(drawing);
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("data:image/png;base64,iVBOR"), std::string::npos);
    EXPECT_NE(svg->find("no flat state"), std::string::npos);
}

}  // namespace
}  // namespace cascade::test
