// Pictures of a surface whose cells have values: smooth from near, even from far, with bumps.
// G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis, 1992), section 5.4.
#pragma once

#include "export/painted_cells.h"
#include "render/draw.h"
#include "run/domain/creased_mesh.h"
#include "surface/cell_filter.h"

#include <vector>

namespace cascade {

/// A surface with its cells, made ready for any number of pictures.
class CellScene {
public:
    /// Both must outlive it. There is at least one cell. Throws std::bad_alloc.
    CellScene(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team);

    /// Colours are those of the filtered values. Where a sample stands for more than the square of
    /// a cell, the colours at the cells' places are taken, blurred by diffusion as widely as it
    /// asks for. `round_shadows` of the options is set, and bumps are shaded but change no outline.
    /// The same picture on any number of threads. Throws std::bad_alloc.
    Image draw(const PaintedCells& look, DrawOptions options, Team& team) const;

    const CellFilter& filter() const { return filter_; }

private:
    const SurfaceCells& cells_;
    DrawnMesh drawn_;
    RayCaster caster_;
    CellFilter filter_;
    float spacing_ = 0;  ///< Of cells, in the unit of what is drawn.
};

}  // namespace cascade
