// The appearance of cells in files and pictures: the values of a canvas, their colours, and the
// material.
#pragma once

#include "export/painted_cells.h"
#include "run/pictures/material.h"
#include "run/pictures/painter.h"

#include <functional>
#include <vector>

namespace cascade {

/// Returns the values of all cells of a field, in the order in which files list the cells.
using InOrder = std::function<std::vector<double>(const Field&)>;

struct CellLook {
    std::size_t channels = 1;
    /// The numbers of all cells, cell after cell. Each cell has `channels` numbers.
    std::vector<float> values;
    PlaceColour colour;
    ValueColours colours;
    /// The height of each cell, in lengths of the model or plane. May be empty.
    std::vector<float> heights;
    Material material;
    /// Whether heights move the surface. If not, they only bend its normals.
    bool displaces = false;

    /// The canvas contains either one number for each cell, which is converted to a colour by
    /// `range` and `palette`, or red, green and blue.
    CellLook(const Canvas& canvas, ValueRange range, const Palette& palette,
             const InOrder& in_order);

    /// Returns the data for painting, which refer to this object. The occlusion is missing, because
    /// it depends on the surface.
    PaintedCells painted() const {
        return {channels, values, colour, heights, material.cells(), displaces, colours};
    }
    /// Returns the data for painting without heights and material.
    PaintedCells painted_alone() const { return {channels, values, colour, {}}; }
};

}  // namespace cascade
