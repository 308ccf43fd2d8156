// Pictures of a surface whose cells have values: smooth from near, even from far, with bumps.
// G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis, 1992), section 5.4.
#pragma once

#include "render/draw.h"
#include "run/creased_mesh.h"
#include "surface/cell_filter.h"

#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// A colour (sRGB) out of the values of all channels at a place. Called from several threads at once.
using CellColour =
    std::function<Colour(std::span<const float> values, const SurfacePlace& place)>;

/// What is seen on the cells. Everything it refers to must stay while it is drawn.
struct CellLook {
    std::size_t channels = 1;
    std::span<const float> values;   ///< `channels` a cell, cell after cell.
    /// Where a value or a colour is not finite the colour is that of NaN.
    CellColour colour;
    /// One a cell: how far it stands out, in the unit of the mesh. Empty: nothing does. Bumps are
    /// shaded but change no outline.
    std::span<const float> heights;
};

/// A surface with its cells, made ready for any number of pictures.
class CellScene {
public:
    /// Both must outlive it. There is at least one cell. Throws std::bad_alloc.
    CellScene(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team);

    /// Colours are those of the filtered values. Where a sample stands for more than the square of a cell,
    /// the colours at the cells' places are taken, blurred by diffusion as widely as it asks for. `round_shadows`
    /// of the options is set. The same picture on any number of threads. Throws std::bad_alloc.
    Image draw(const CellLook& look, DrawOptions options, Team& team) const;

    const CellFilter& filter() const { return filter_; }

private:
    const SurfaceCells& cells_;
    DrawnMesh drawn_;
    RayCaster caster_;
    CellFilter filter_;
    float spacing_ = 0;  ///< Of cells, in the unit of what is drawn.
};

}  // namespace cascade
