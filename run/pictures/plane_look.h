// The appearance of a plane, or of a slice of a volume, in maps. Also the appearance of a grid that
// is bent into a surface.
#pragma once

#include "export/flat_cells.h"
#include "run/pictures/cell_look.h"
#include "run/pictures/surface_finish.h"

namespace cascade {

/// The cells of a plane, row by row from the top. The opacity outside the domain is 0.
struct PlaneLook : CellLook {
    FlatCells cells;

    /// The fields of the canvas must have as many columns and rows as `plane`.
    PlaneLook(const Canvas& canvas, ValueRange range, const Palette& palette, FlatCells plane);
};

/// Returns the material of a canvas of a grid that is bent into a surface.
GridMaterial grid_material(const Canvas& canvas, const DomainSettings& domain);

GridMaterial grid_material(const Canvas& canvas, const DomainSettings& domain);

}  // namespace cascade
