// Places ticks at 1, 2 and 5 times powers of ten.
#include "picture/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr double left_margin = 76, right_margin = 24, top_margin = 44, bottom_margin = 52;

}  // namespace

std::vector<double> ticks_of(const AxisRange& range, int count) {
    const auto [low, high] = std::minmax(range.low, range.high);
    const double rough = (high - low) / count;
    if (!(rough > 0) || !std::isfinite(rough)) return {};
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double part = rough / power;
    const double step = power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
        ticks.push_back(k == 0 ? 0 : k * step);
    }
    return ticks;
}

void draw_frame(Drawing& drawing, const AxisBox& box) {
    const auto& [left, top, right, bottom] = box;
    drawing.add(DrawnLine{{{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}},
                          axis_ink,
                          1,
                          false});
}

Axes::Axes(AxisRange across, AxisRange up, double width, double height)
    : Axes(std::move(across), std::move(up),
           {left_margin, top_margin, width - right_margin, height - bottom_margin}) {}

Axes::Axes(AxisRange across, AxisRange up, const AxisBox& box)
    : across_(std::move(across)),
      up_(std::move(up)),
      left_(box.left),
      right_(box.right),
      top_(box.top),
      bottom_(box.bottom) {}

DrawnPoint Axes::place(double across, double up) const {
    return {left_ + (right_ - left_) * (across - across_.low) / (across_.high - across_.low),
            bottom_ - (bottom_ - top_) * (up - up_.low) / (up_.high - up_.low)};
}

void Axes::draw(Drawing& drawing) const {
    using Anchor = DrawnText::Anchor;
    constexpr double length = 5;
    const auto line = [&](DrawnPoint a, DrawnPoint b) {
        drawing.add(DrawnLine{{a, b}, axis_ink, 1, false});
    };
    const auto text = [&](DrawnPoint place, std::string words, Anchor anchor) {
        drawing.add(DrawnText{place, std::move(words), anchor});
    };
    for (const double tick : ticks_of(across_, 8)) {
        const double x = place(tick, up_.low)[0];
        line({x, bottom_}, {x, bottom_ + length});
        text({x, bottom_ + 15}, fmt::format("{:.6g}", tick), Anchor::middle);
    }
    for (const double tick : ticks_of(up_, 6)) {
        const double y = place(across_.low, tick)[1];
        line({left_ - length, y}, {left_, y});
        text({left_ - 9, y}, fmt::format("{:.6g}", tick), Anchor::end);
    }
    draw_frame(drawing, {left_, top_, right_, bottom_});
    text({(left_ + right_) / 2, bottom_ + 36}, across_.name, Anchor::middle);
    text({left_, top_ - 11}, up_.name, Anchor::start);
}

void Axes::draw_curve(Drawing& drawing, const std::vector<double>& across,
                      const std::vector<double>& up, DrawnLine style) const {
    const auto flush = [&] {
        if (style.points.size() > 1) drawing.add(style);
        style.points.clear();
    };
    style.points.clear();
    for (std::size_t k = 0; k < across.size(); ++k) {
        const bool is_inside = up[k] >= up_.low && up[k] <= up_.high && across[k] <= across_.high;
        const bool was_inside = !style.points.empty();
        if (is_inside == was_inside || k == 0) {
            if (is_inside) style.points.push_back(place(across[k], up[k]));
            continue;
        }
        // The segment crosses an edge of the box.
        double part = 1;
        if (across[k] > across_.high) {
            part = (across_.high - across[k - 1]) / (across[k] - across[k - 1]);
        } else if (std::isfinite(up[k]) && std::isfinite(up[k - 1])) {
            const double outer = is_inside ? up[k - 1] : up[k];
            const double edge = outer < up_.low ? up_.low : up_.high;
            part = (edge - up[k - 1]) / (up[k] - up[k - 1]);
        } else {
            part = is_inside ? 1 : 0;
        }
        const double height = up[k - 1] + part * (up[k] - up[k - 1]);
        if (std::isfinite(height)) {
            style.points.push_back(place(across[k - 1] + part * (across[k] - across[k - 1]),
                                         std::clamp(height, up_.low, up_.high)));
        }
        if (is_inside) {
            style.points.push_back(place(across[k], up[k]));
        } else {
            flush();
        }
    }
    flush();
}

}  // namespace cascade
