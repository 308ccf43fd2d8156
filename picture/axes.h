// The frame of a diagram: a box with ticks and numbers. Also computes where a pair of values is in
// the box.
#pragma once

#include "picture/drawing.h"

#include <string>
#include <vector>

namespace cascade {

/// The values at the two ends of an axis. If low > high, values increase downwards or to the left.
struct AxisRange {
    double low = 0, high = 1;
    std::string name;
};

/// The box of a diagram in a drawing.
struct AxisBox {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// About `count` round numbers within a range, in ascending order.
std::vector<double> ticks_of(const AxisRange& range, int count);

/// Adds the outline of a box.
void draw_frame(Drawing& drawing, const AxisBox& box);

class Axes {
public:
    /// Places the box in a drawing of `width` × `height`, with margins for the numbers.
    Axes(AxisRange across, AxisRange up, double width, double height);
    Axes(AxisRange across, AxisRange up, const AxisBox& box);

    DrawnPoint place(double across, double up) const;
    double left() const { return left_; }
    double right() const { return right_; }
    double top() const { return top_; }
    double bottom() const { return bottom_; }

    /// Adds the box, its ticks and numbers, and the names of the axes to a drawing.
    void draw(Drawing& drawing) const;
    /// Adds a curve to a drawing. Leaves out the parts above, below and to the right of the box.
    void draw_curve(Drawing& drawing, const std::vector<double>& across,
                    const std::vector<double>& up, DrawnLine style) const;

private:
    AxisRange across_, up_;
    double left_, right_, top_, bottom_;
};

inline constexpr Colour axis_ink{0.16F, 0.16F, 0.17F};
inline constexpr Colour axis_faint{0.86F, 0.86F, 0.86F};

}  // namespace cascade
