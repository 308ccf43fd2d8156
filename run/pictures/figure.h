// Figures for papers: a picture with axes in lengths and a bar of its colours, or a curve.
#pragma once

#include "core/palette.h"
#include "picture/drawing.h"
#include "picture/image.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The meaning of a picture's colours.
struct ColourBar {
    const Palette* palette = nullptr;
    ValueRange range;  ///< The values at the two ends of the palette.
    std::string name;  ///< The name of the number shown.
};

/// The rectangle of the plane covered by a picture, in lengths: x runs to the right and y down.
struct PlaneExtent {
    double width = 1, height = 1;
    std::string across = "x", down = "y";
};

/// The picture with its title above it, ticks at its sides if it shows a plane, and a bar at its
/// right if its colours represent numbers. A plane keeps its proportions up to 1 : 12.
Drawing draw_figure(const Image& picture, const std::string& title,
                    const std::optional<PlaneExtent>& plane, const std::optional<ColourBar>& bar);

/// Figures as the panels of one, in rows of at most three, four in a square, with a title above
/// them.
Drawing side_by_side(std::span<const Drawing> panels, const std::string& title);

/// A number along a line of cells: a curve over the length, from the lowest to the highest value.
/// Values that are not finite leave gaps.
Drawing draw_curve_figure(const std::vector<double>& values, double length,
                          const std::string& title, const std::string& name);

}  // namespace cascade
