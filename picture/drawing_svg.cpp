// Writes a drawing as SVG. Every shape becomes one element.
#include "picture/drawing.h"

#include "core/base64.h"
#include "picture/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cascade {

namespace {

/// Enlarges an image until its pixels are at most half a unit wide, but to at most 2²² pixels.
/// Programs that smooth images, such as librsvg, then blur only the edges of the squares that
/// replace the original pixels.
Image in_small_pixels(const DrawnImage& drawn) {
    constexpr double per_unit = 2;
    constexpr std::int64_t most_pixels = std::int64_t{1} << 22;
    const Image& image = drawn.image;
    // An axis with a single pixel has no edges that could be blurred.
    const auto units_of_pixel = [](double length, std::int64_t count) {
        return count > 1 ? length / static_cast<double>(count) : 0.0;
    };
    const double wanted =
        std::ceil(per_unit * std::max(units_of_pixel(drawn.width, image.width),
                                      units_of_pixel(drawn.height, image.height)));
    const double possible = std::sqrt(static_cast<double>(most_pixels) /
                                      static_cast<double>(image.width * image.height));
    return enlarge(image, std::max(1, static_cast<int>(std::min(wanted, possible))));
}

class Writer {
public:
    Result<std::string> write(const Drawing& drawing) {
        text_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.5g}\" height=\"{1:.5g}\" "
            "viewBox=\"0 0 {0:.5g} {1:.5g}\" font-family=\"sans-serif\" font-size=\"13\">\n",
            drawing.width, drawing.height);
        for (const auto& shape : drawing.shapes) {
            if (auto done = std::visit([&](const auto& each) { return add(each); }, shape); !done) {
                return tl::unexpected(done.error());
            }
        }
        return text_ + "</svg>\n";
    }

private:
    Result<void> add(const DrawnLine& line) {
        std::string points;
        for (const DrawnPoint& point : line.points) {
            points += fmt::format("{}{:.2f},{:.2f}", points.empty() ? "" : " ", point[0], point[1]);
        }
        text_ += fmt::format(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3g}\"{}/>\n",
            points, hexadecimal(line.colour), line.width,
            line.dashed ? " stroke-dasharray=\"5 4\"" : "");
        return {};
    }

    Result<void> add(const DrawnArea& area) {
        text_ += fmt::format(
            "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
            area.corner[0], area.corner[1], area.width, area.height, hexadecimal(area.colour));
        return {};
    }

    Result<void> add(const DrawnDisc& disc) {
        text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n",
                             disc.centre[0], disc.centre[1], disc.radius, hexadecimal(disc.colour));
        return {};
    }

    Result<void> add(const DrawnText& text) {
        const char* const anchor = text.anchor == DrawnText::Anchor::start    ? "start"
                                   : text.anchor == DrawnText::Anchor::middle ? "middle"
                                                                              : "end";
        text_ += fmt::format(
            "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" fill=\"#29292b\">{}</text>\n",
            text.place[0], text.place[1] + 4.5, anchor, xml_escaped(text.text));
        return {};
    }

    Result<void> add(const DrawnImage& image) {
        const auto bytes = encode_png(in_small_pixels(image), PngDepth::eight, {});
        if (!bytes) return tl::unexpected(bytes.error());
        text_ += fmt::format(
            "<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
            "preserveAspectRatio=\"none\" image-rendering=\"pixelated\" "
            "href=\"data:image/png;base64,{}\"/>\n",
            image.corner[0], image.corner[1], image.width, image.height, base64(*bytes));
        return {};
    }

    std::string text_;
};

}  // namespace

Result<std::string> as_svg(const Drawing& drawing) { return Writer().write(drawing); }

}  // namespace cascade
