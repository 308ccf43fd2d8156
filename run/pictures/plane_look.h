// The appearance of a plane, or of a slice of a volume, in maps.
#pragma once

#include "export/flat_cells.h"
#include "run/pictures/cell_look.h"

namespace cascade {

/// The cells of a plane, row by row from the top. The opacity outside the domain is 0.
struct PlaneLook : CellLook {
    FlatCells cells;

    /// The fields of the canvas must have as many columns and rows as `plane`.
    PlaneLook(const Canvas& canvas, ValueRange range, const Palette& palette, FlatCells plane);
};

}  // namespace cascade
