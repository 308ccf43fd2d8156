// Draws a drawing as pixels. Edges of lines and discs are smoothed: the colour covers each pixel in
// proportion to the covered part of the pixel.
#include "picture/drawing.h"
#include "picture/lettering.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cascade {

namespace {

class Raster {
public:
    Raster(const Drawing& drawing, int scale)
        : scale_(scale),
          image_(static_cast<std::int64_t>(std::ceil(drawing.width * scale)),
                 static_cast<std::int64_t>(std::ceil(drawing.height * scale))) {}

    Image draw(const Drawing& drawing) && {
        for (const auto& shape : drawing.shapes) {
            std::visit([&](const auto& each) { add(each); }, shape);
        }
        return std::move(image_);
    }

private:
    DrawnPoint scaled(const DrawnPoint& point) const {
        return {point[0] * scale_, point[1] * scale_};
    }

    void mix(std::int64_t x, std::int64_t y, const Colour& colour, double part) {
        if (part <= 0) return;
        Colour& pixel = image_.at(x, y);
        const auto weight = static_cast<float>(std::min(part, 1.0));
        for (std::size_t k = 0; k < 3; ++k) pixel[k] += weight * (colour[k] - pixel[k]);
    }

    /// Calls `cover` with the centre of each pixel within `reach` of the box between two points.
    /// `cover` returns the fraction of the pixel that is covered.
    template <typename Cover>
    void paint(DrawnPoint low, DrawnPoint high, double reach, const Colour& colour,
               const Cover& cover) {
        const auto from = [&](double value, std::int64_t) {
            return std::max<std::int64_t>(0, static_cast<std::int64_t>(value - reach - 1));
        };
        const auto to = [&](double value, std::int64_t side) {
            return std::min(side - 1, static_cast<std::int64_t>(value + reach + 1));
        };
        for (auto y = from(low[1], image_.height); y <= to(high[1], image_.height); ++y) {
            for (auto x = from(low[0], image_.width); x <= to(high[0], image_.width); ++x) {
                mix(x, y, colour,
                    cover(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5));
            }
        }
    }

    void segment(DrawnPoint a, DrawnPoint b, const Colour& colour, double width) {
        const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
        paint({std::min(a[0], b[0]), std::min(a[1], b[1])},
              {std::max(a[0], b[0]), std::max(a[1], b[1])}, width, colour, [&](double x, double y) {
                  const double at = square > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / square : 0;
                  const double t = std::clamp(at, 0.0, 1.0);
                  return width / 2 + 0.5 - std::hypot(x - a[0] - t * dx, y - a[1] - t * dy);
              });
    }

    void add(const DrawnLine& line) {
        constexpr double dash = 5, gap = 4;
        double gone = 0;
        for (std::size_t k = 1; k < line.points.size(); ++k) {
            const DrawnPoint a = scaled(line.points[k - 1]), b = scaled(line.points[k]);
            const double width = line.width * scale_;
            if (!line.dashed) {
                segment(a, b, line.colour, width);
                continue;
            }
            const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
            const double period = (dash + gap) * scale_;
            for (double at = 0; at < length;) {
                const double in_period = std::fmod(gone + at, period);
                const bool is_dash = in_period < dash * scale_;
                const double end =
                    std::min(length, at + (is_dash ? dash * scale_ : period) - in_period + 1e-9);
                const auto place = [&](double part) {
                    return DrawnPoint{a[0] + (b[0] - a[0]) * part / length,
                                      a[1] + (b[1] - a[1]) * part / length};
                };
                if (is_dash) segment(place(at), place(end), line.colour, width);
                at = end;
            }
            gone += length;
        }
    }

    void add(const DrawnArea& area) {
        const DrawnPoint low = scaled(area.corner);
        const DrawnPoint high = scaled({area.corner[0] + area.width, area.corner[1] + area.height});
        paint(low, high, 0, area.colour, [&](double x, double y) {
            return x >= low[0] && x < high[0] && y >= low[1] && y < high[1] ? 1.0 : 0.0;
        });
    }

    void add(const DrawnDisc& disc) {
        const DrawnPoint centre = scaled(disc.centre);
        const double radius = disc.radius * scale_;
        paint(centre, centre, radius, disc.colour, [&](double x, double y) {
            return radius + 0.5 - std::hypot(x - centre[0], y - centre[1]);
        });
    }

    void add(const DrawnText& text) {
        const DrawnPoint place = scaled(text.place);
        const std::int64_t width = text_width(text.text, scale_);
        const std::int64_t back = text.anchor == DrawnText::Anchor::start    ? 0
                                  : text.anchor == DrawnText::Anchor::middle ? width / 2
                                                                             : width;
        const auto x = std::max<std::int64_t>(0, std::lround(place[0]) - back);
        draw_text(image_, text.text, x, std::lround(place[1]) - 7 * scale_ / 2, image_.width - x,
                  scale_);
    }

    void add(const DrawnImage& drawn) {
        const DrawnPoint low = scaled(drawn.corner);
        const double width = drawn.width * scale_, height = drawn.height * scale_;
        const auto side = [](std::int64_t count) { return static_cast<double>(count); };
        const auto left = std::lround(low[0]), top = std::lround(low[1]);
        for (std::int64_t y = 0; y < std::lround(height); ++y) {
            for (std::int64_t x = 0; x < std::lround(width); ++x) {
                if (left + x >= image_.width || top + y >= image_.height) continue;
                const auto from = [](double value, std::int64_t count) {
                    return std::min(count - 1, static_cast<std::int64_t>(value));
                };
                Colour& pixel = image_.at(left + x, top + y);
                pixel = drawn.image.over(
                    pixel,
                    from((side(x) + 0.5) * side(drawn.image.width) / width, drawn.image.width),
                    from((side(y) + 0.5) * side(drawn.image.height) / height, drawn.image.height));
            }
        }
    }

    int scale_;
    Image image_;
};

}  // namespace

Image as_image(const Drawing& drawing, int scale) { return Raster(drawing, scale).draw(drawing); }

}  // namespace cascade
