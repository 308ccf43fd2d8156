// The appearance of cells in files and pictures: the values of a canvas, their colours, and the
// material.
#pragma once

#include "export/painted_cells.h"
#include "run/pictures/material.h"
#include "run/pictures/painter.h"

#include <functional>
#include <vector>

namespace cascade {

/// The values of all cells of a field in the order of files.
using InOrder = std::function<std::vector<double>(const Field&)>;

struct CellLook {
    std::size_t channels = 1;
    std::vector<float> values;  ///< `channels` numbers per cell, cell after cell.
    PlaceColour colour;
    ValueColours colours;
    std::vector<float> heights;  ///< One per cell, in units of the model or plane. May be empty.
    Material material;
    bool displaces = false;  ///< Heights move the surface. Otherwise they only bend its normals.

    /// A number for the palette, to which the range applies, or red, green and blue.
    CellLook(const Canvas& canvas, ValueRange range, const Palette& palette,
             const InOrder& in_order);

    /// Refers to this object. Without occlusion, which depends on the surface.
    PaintedCells painted() const {
        return {channels, values, colour, heights, material.cells(), displaces, colours};
    }
    /// The same without heights and material.
    PaintedCells painted_alone() const { return {channels, values, colour, {}}; }
};

}  // namespace cascade
