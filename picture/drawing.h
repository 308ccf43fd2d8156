// Drawings of lines, areas and texts, for diagrams: as SVG, or as an image of pixels.
#pragma once

#include "core/palette.h"
#include "picture/image.h"

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cascade {

/// A position in a drawing: to the right and down, in units of which a text line is 14 high.
using DrawnPoint = std::array<double, 2>;

struct DrawnLine {
    std::vector<DrawnPoint> points;  ///< In the order in which they are joined.
    Colour colour{0, 0, 0};
    double width = 1;
    bool dashed = false;
};

struct DrawnArea {
    DrawnPoint corner{};  ///< The upper left corner.
    double width = 0, height = 0;
    Colour colour{1, 1, 1};
};

struct DrawnDisc {
    DrawnPoint centre{};
    double radius = 1;
    Colour colour{0, 0, 0};
};

/// A line of text, in the colour of sheets.
struct DrawnText {
    enum class Anchor { start, middle, end };
    DrawnPoint place{};  ///< The anchor, at half the line's height.
    std::string text;
    Anchor anchor = Anchor::start;
};

/// An image that fills an area, without smoothing.
struct DrawnImage {
    DrawnPoint corner{};
    double width = 0, height = 0;
    Image image;
};

/// Later shapes cover earlier ones.
struct Drawing {
    double width = 0, height = 0;
    std::vector<std::variant<DrawnLine, DrawnArea, DrawnDisc, DrawnText, DrawnImage>> shapes;

    template <typename Shape>
    void add(Shape shape) {
        shapes.emplace_back(std::in_place_type<Shape>, std::move(shape));
    }
};

/// An SVG file. Fails if an image of the drawing cannot be encoded.
Result<std::string> as_svg(const Drawing& drawing);

/// A PDF file of one page. Texts are Latin-1 and Greek letters. Other letters become question
/// marks. Fails if the page is larger than the format admits.
Result<std::string> as_pdf(const Drawing& drawing);

/// The drawing with `scale` pixels per unit, from 1 to 8.
Image as_image(const Drawing& drawing, int scale);

/// Writes the format of the name's ending: .svg, .pdf, or .png with two pixels per unit. Fails as
/// these and write_file() do, and on other endings.
Result<void> write_drawing(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace cascade
