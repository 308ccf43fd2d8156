// Arranges the parts of a figure. picture/axes draws ticks and frames.
#include "run/pictures/figure.h"

#include "core/check.h"
#include "picture/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace cascade {

namespace {

// Sides of pictures, in the units of drawings.
constexpr double figure_side = 480, least_figure_side = 40;
constexpr double title_height = 44, margin = 24;
constexpr double numbers_left = 76, numbers_below = 52;
constexpr double bar_gap = 22, bar_width = 15, bar_numbers = 76;
constexpr std::int64_t bar_steps = 256;

struct Size {
    double width, height;
};

Size shown_size(double width, double height) {
    const double scale = figure_side / std::max(width, height);
    return {std::max(least_figure_side, width * scale),
            std::max(least_figure_side, height * scale)};
}

void add_text(Drawing& drawing, DrawnPoint place, std::string text, DrawnText::Anchor anchor) {
    if (!text.empty()) drawing.add(DrawnText{place, std::move(text), anchor});
}

/// Draws the palette as a bar from bottom to top.
Image image_of(const Palette& palette) {
    Image image(1, bar_steps);
    for (std::int64_t k = 0; k < bar_steps; ++k) {
        const double position = 1 - (static_cast<double>(k) + 0.5) / bar_steps;
        image.at(0, k) = colour_at(palette, position);
    }
    return image;
}

void draw_bar(Drawing& drawing, const ColourBar& bar, const AxisBox& box) {
    using Anchor = DrawnText::Anchor;
    CHECK(bar.palette != nullptr, "the colours of a bar are those of a palette");
    const double low = bar.range.low, high = bar.range.high;
    drawing.add(
        DrawnImage{{box.left, box.top}, bar_width, box.bottom - box.top, image_of(*bar.palette)});
    const AxisBox frame{box.left, box.top, box.left + bar_width, box.bottom};
    draw_frame(drawing, frame);
    // If all values are equal, their colour is the middle of the palette.
    const AxisRange range =
        low == high ? AxisRange{low - 1, high + 1, {}} : AxisRange{low, high, {}};
    const std::vector<double> ticks = low == high ? std::vector<double>{low} : ticks_of(range, 6);
    const Axes axes({0, 1, {}}, range, frame);
    for (const double tick : ticks) {
        const double y = axes.place(0, tick)[1];
        drawing.add(DrawnLine{{{frame.right, y}, {frame.right + 5, y}}, axis_ink, 1, false});
        add_text(drawing, {frame.right + 9, y}, fmt::format("{:.6g}", tick), Anchor::start);
    }
    add_text(drawing, {frame.left, frame.top - 11}, bar.name, Anchor::start);
}

Drawing empty_figure(double width, double height) {
    Drawing drawing{width, height, {}};
    drawing.add(DrawnArea{{0, 0}, width, height, {1, 1, 1}});
    return drawing;
}

void move(DrawnPoint& point, const DrawnPoint& by) { point = {point[0] + by[0], point[1] + by[1]}; }
void move(DrawnLine& line, const DrawnPoint& by) {
    for (DrawnPoint& point : line.points) move(point, by);
}
void move(DrawnArea& area, const DrawnPoint& by) { move(area.corner, by); }
void move(DrawnDisc& disc, const DrawnPoint& by) { move(disc.centre, by); }
void move(DrawnText& text, const DrawnPoint& by) { move(text.place, by); }
void move(DrawnImage& image, const DrawnPoint& by) { move(image.corner, by); }

/// Adds the shapes of another drawing, moved to the right and down.
void add_moved(Drawing& drawing, const Drawing& part, const DrawnPoint& by) {
    for (auto shape : part.shapes) {
        std::visit([&](auto& each) { move(each, by); }, shape);
        drawing.shapes.push_back(std::move(shape));
    }
}

}  // namespace

Drawing draw_figure(const Image& picture, const std::string& title,
                    const std::optional<PlaneExtent>& plane, const std::optional<ColourBar>& bar) {
    const Size size =
        plane ? shown_size(plane->width, plane->height)
              : shown_size(static_cast<double>(picture.width), static_cast<double>(picture.height));
    const double left = plane ? numbers_left : margin, below = plane ? numbers_below : margin;
    const AxisBox box{left, title_height, left + size.width, title_height + size.height};
    const double right = bar ? bar_gap + bar_width + bar_numbers : margin;
    Drawing drawing = empty_figure(box.right + right, box.bottom + below);
    drawing.add(DrawnImage{{box.left, box.top}, size.width, size.height, picture});
    if (plane) {
        Axes({0, plane->width, plane->across}, {plane->height, 0, plane->down}, box).draw(drawing);
    }
    if (bar) {
        draw_bar(drawing, *bar, {box.right + bar_gap, box.top, box.right + right, box.bottom});
    }
    add_text(drawing, {box.left, 14}, title, DrawnText::Anchor::start);
    return drawing;
}

Drawing side_by_side(std::span<const Drawing> panels, const std::string& title) {
    constexpr std::size_t most_columns = 3;
    constexpr double title_above = 30;
    const std::size_t columns = panels.size() == 4 ? 2 : std::min(panels.size(), most_columns);
    // A column is as wide as its widest panel, and a row is as high as its highest panel.
    std::vector<double> widths(columns, 0), heights;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (k % columns == 0) heights.push_back(0);
        widths[k % columns] = std::max(widths[k % columns], panels[k].width);
        heights.back() = std::max(heights.back(), panels[k].height);
    }
    const auto sum = [](const std::vector<double>& sizes, std::size_t count) {
        return std::accumulate(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(count),
                               0.0);
    };
    Drawing drawing =
        empty_figure(sum(widths, columns), title_above + sum(heights, heights.size()));
    add_text(drawing, {margin, 18}, title, DrawnText::Anchor::start);
    for (std::size_t k = 0; k < panels.size(); ++k) {
        add_moved(drawing, panels[k],
                  {sum(widths, k % columns), title_above + sum(heights, k / columns)});
    }
    return drawing;
}

Drawing draw_curve_figure(const std::vector<double>& values, double length,
                          const std::string& title, const std::string& name,
                          const std::string& across) {
    constexpr double width = 640, height = 360;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::vector<double> places;
    for (const double value : values) {
        const auto k = static_cast<double>(places.size());
        places.push_back((k + 0.5) * length / static_cast<double>(values.size()));
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (!(low <= high)) low = high = 0;
    const double pad = low < high ? 0.05 * (high - low) : std::max(1.0, std::abs(low));
    Drawing drawing = empty_figure(width, height);
    const Axes axes({0, length, across}, {low - pad, high + pad, name}, width, height);
    axes.draw(drawing);
    axes.draw_curve(drawing, places, values, DrawnLine{{}, {0.10F, 0.35F, 0.65F}, 1.5, false});
    add_text(drawing, {axes.left(), 14}, title, DrawnText::Anchor::start);
    return drawing;
}

}  // namespace cascade
