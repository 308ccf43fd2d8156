// The appearance of a plane, or of a slice of a volume, in maps.
#pragma once

#include "export/flat_cells.h"
#include "run/pictures/cell_look.h"

namespace cascade {

/// The cells of a plane in rows from the top. Outside of the domain the opacity is 0.
struct PlaneLook : CellLook {
    FlatCells cells;

    /// The fields of the canvas have the columns and rows of `plane`.
    PlaneLook(const Canvas& canvas, ValueRange range, const Palette& palette, FlatCells plane);
};

}  // namespace cascade
