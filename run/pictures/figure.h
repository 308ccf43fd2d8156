// Draws figures for papers. A figure is a picture with axes in units of length and a bar of its
// colours, or a curve.
#pragma once

#include "core/palette.h"
#include "picture/drawing.h"
#include "picture/image.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// A legend for the colours of a picture.
struct ColourBar {
    const Palette* palette = nullptr;
    ValueRange range;  ///< The values at the ends of the palette.
    std::string name;  ///< The name of the number that the colours represent.
};

/// The rectangle that a picture shows, in units of length. x runs to the right and y runs down.
struct PlaneExtent {
    double width = 1, height = 1;
    std::string across = "x", down = "y";
};

/// Draws a picture with a title above it. A picture of a plane has ticks at its sides, and a
/// picture whose colours represent numbers has a bar at its right. The sides of a plane are drawn
/// in their true proportions, unless one side is more than 12 times as long as another.
Drawing draw_figure(const Image& picture, const std::string& title,
                    const std::optional<PlaneExtent>& plane, const std::optional<ColourBar>& bar);

/// Combines figures as panels, with a title above them. Four panels form a square. Any other number
/// of panels forms rows with at most three panels.
Drawing side_by_side(std::span<const Drawing> panels, const std::string& title);

/// Draws a number along a line of cells as a curve, from its lowest to its highest value. Values
/// that are not finite leave gaps. `across` is the name of the axis along the line.
Drawing draw_curve_figure(const std::vector<double>& values, double length,
                          const std::string& title, const std::string& name,
                          const std::string& across = "x");

}  // namespace cascade
