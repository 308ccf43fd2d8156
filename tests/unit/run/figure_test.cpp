// Figures: their titles, axes, colour bars and curves.
#include "run_fixture.h"

#include "run/pictures/figure.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::Not;

class FigureTest : public RunTest {
protected:
    std::string figure(const std::string& text, const PictureRequest& picture = {}) {
        Script script = load(text);
        RunRequest wanted = request();
        wanted.outputs = {path("figure.svg")};
        wanted.picture = picture;
        run_well(script, wanted);
        return read_file(path("figure.svg"), std::uint64_t{1} << 24).value_or("");
    }
};

TEST_F(FigureTest, OfAPlaneHasLengthsAndColours) {
    const std::string svg = figure(
        "system s { u: 20 * x - 5; u' = 0 }\ndomain { grid: 40, 20; spacing: 0.5 }\n"
        "stage left_to_right: s { duration: 3; speed: 1 }\n");
    EXPECT_THAT(svg, HasSubstr("<svg "));
    EXPECT_THAT(svg, HasSubstr(">test.cascade: left_to_right, t = 3</text>"));
    // The domain is 20 units wide and 10 high, and u goes from −4.75 to 14.75.
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"middle\" fill=\"#29292b\">20</text>"));
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"end\" fill=\"#29292b\">10</text>"));
    EXPECT_THAT(svg, Not(HasSubstr("text-anchor=\"end\" fill=\"#29292b\">12</text>")));
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"start\" fill=\"#29292b\">u</text>"));
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"start\" fill=\"#29292b\">10</text>"));
    EXPECT_THAT(svg, Not(HasSubstr("text-anchor=\"start\" fill=\"#29292b\">15</text>")));
    EXPECT_THAT(svg, HasSubstr("width=\"480.00\" height=\"240.00\""));
}

TEST_F(FigureTest, NamesWhatIsShownAndKeepsTheRange) {
    PictureRequest picture = picture_of("u < 1");
    picture.range = ValueRange{1, 0};
    const std::string svg = figure(
        "system s { u: 2 * x; u' = 0 }\ndomain { grid: 16, 16 }\nstage a: s { iterations: 1 }\n",
        picture);
    EXPECT_THAT(svg, HasSubstr(">u &lt; 1</text>"));
    EXPECT_THAT(svg, HasSubstr(">0.2</text>"));
}

TEST_F(FigureTest, OfColoursHasNoBar) {
    const std::string svg = figure(
        "system s { u: x; u' = 0 }\ndomain { grid: 16, 16 }\nstage a: s { iterations: 1 }\n"
        "picture { color: rgb(u, 0, 0) }\n");
    EXPECT_THAT(svg, Not(HasSubstr("text-anchor=\"start\" fill=\"#29292b\">u</text>")));
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"middle\" fill=\"#29292b\">16</text>"));
}

TEST_F(FigureTest, OfAPaletteOfTheScriptHasItsBar) {
    const std::string svg = figure(
        "let most = 8\nsystem s { u: x; u' = 0 }\ndomain { grid: 16, 16 }\n"
        "stage a: s { iterations: 1 }\npicture { color: palette(2 * u, -most, most, \"tan\") }\n");
    EXPECT_THAT(svg, HasSubstr(">2 * u</text>"));
    EXPECT_THAT(svg, HasSubstr(">-6</text>"));
}

TEST_F(FigureTest, OfALineOfCellsIsACurve) {
    const std::string svg = figure(
        "system s { u: x^2; u' = 0 }\ndomain { grid: 50; spacing: 0.1 }\n"
        "stage a: s { iterations: 1 }\n");
    EXPECT_THAT(svg, Not(HasSubstr("<image")));
    EXPECT_THAT(svg, HasSubstr("stroke=\"#1a59a6\""));
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"middle\" fill=\"#29292b\">5</text>"));
}

TEST_F(FigureTest, OfAModelHasNoAxes) {
    const std::string svg = figure(
        "system s { u: x; u' = 0 }\ndomain { surface: sphere; cells: 400 }\n"
        "stage a: s { iterations: 1 }\n");
    EXPECT_THAT(svg, HasSubstr("<image"));
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"start\" fill=\"#29292b\">u</text>"));
    EXPECT_THAT(svg, Not(HasSubstr("text-anchor=\"middle\"")));
}

TEST(Figures, OfAnEvenFieldNameItsValue) {
    const auto svg = as_svg(draw_figure(Image(4, 4), "even", PlaneExtent{4, 4, "x", "y"},
                                        ColourBar{find_palette("grey"), {0.25F, 0.25F}, "u"}));
    ASSERT_TRUE(svg);
    EXPECT_THAT(*svg, HasSubstr(">0.25</text>"));
}

TEST(Figures, HavePanelsInRowsOfThree) {
    const Drawing panel = draw_figure(Image(4, 4), "panel", {}, {});
    const std::vector<Drawing> panels(5, panel);
    const Drawing figure = side_by_side(panels, "all");
    EXPECT_EQ(figure.width, 3 * panel.width);
    EXPECT_GT(figure.height, 2 * panel.height);
    std::vector<DrawnPoint> corners;
    for (const auto& shape : figure.shapes) {
        if (const auto* image = std::get_if<DrawnImage>(&shape)) corners.push_back(image->corner);
    }
    ASSERT_EQ(corners.size(), 5U);
    EXPECT_EQ(corners[1][0], corners[0][0] + panel.width);
    EXPECT_EQ(corners[1][1], corners[0][1]);
    EXPECT_EQ(corners[3][0], corners[0][0]);
    EXPECT_EQ(corners[3][1], corners[0][1] + panel.height);
    EXPECT_EQ(side_by_side(std::span(panels).first(4), "all").width, 2 * panel.width);
}

/// The longer side of a very long plane has the usual length, and the shorter one is still visible.
TEST(Figures, OfLongPlanesCanBeSeen) {
    const Drawing drawing = draw_figure(Image(1000, 1), "long", PlaneExtent{1000, 1, "x", "y"}, {});
    EXPECT_GT(drawing.height, 100);
    EXPECT_LT(drawing.width, 700);
}

TEST(Figures, LeaveGapsInCurves) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Drawing drawing = draw_curve_figure({1, 2, nan, 2, 1}, 5, "gap", "u");
    int curves = 0;
    for (const auto& shape : drawing.shapes) {
        const auto* line = std::get_if<DrawnLine>(&shape);
        curves += line != nullptr && line->width > 1;
    }
    EXPECT_EQ(curves, 2);
}

}  // namespace
}  // namespace cascade
