// Drawings of lines, areas and texts, for diagrams. A drawing becomes an SVG file, a PDF file or an
// image.
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

/// A position in a drawing: its distance from the left and its distance from the top. A line of
/// text is 14 units high.
using DrawnPoint = std::array<double, 2>;

struct DrawnLine {
    std::vector<DrawnPoint> points;  ///< The corners, in the order in which they are connected.
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

/// A line of text in the same colour as the text of contact sheets.
struct DrawnText {
    enum class Anchor { start, middle, end };
    /// The position of the start, middle or end of the text (see `anchor`), at half the height of
    /// the line.
    DrawnPoint place{};
    std::string text;
    Anchor anchor = Anchor::start;
};

/// An image that fills an area. Its pixels are enlarged without smoothing.
struct DrawnImage {
    DrawnPoint corner{};
    double width = 0, height = 0;
    Image image;
};

/// Lines, areas, texts and images. Each covers the earlier ones.
struct Drawing {
    double width = 0, height = 0;
    std::vector<std::variant<DrawnLine, DrawnArea, DrawnDisc, DrawnText, DrawnImage>> shapes;

    template <typename Shape>
    void add(Shape shape) {
        shapes.emplace_back(std::in_place_type<Shape>, std::move(shape));
    }
};

/// Converts a drawing to an SVG file. Fails if one of its images cannot be encoded.
Result<std::string> as_svg(const Drawing& drawing);

/// Converts a drawing to a PDF file with one page. Texts may contain Latin-1 and Greek letters. Any
/// other letter is replaced by a question mark. Fails if the page is larger than the format
/// permits.
Result<std::string> as_pdf(const Drawing& drawing);

/// Draws a drawing as an image with `scale` pixels for each unit of length. `scale` is from 1 to 8.
Image as_image(const Drawing& drawing, int scale);

/// Writes a file in the format of its ending: .svg, .pdf, or .png with two pixels for each unit.
/// Fails for other endings, and whenever as_svg(), as_pdf() or write_file() would fail.
Result<void> write_drawing(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace cascade
