// Draws a surface whose cells have values. Pictures are smooth at close range and antialiased at a
// distance, and may have bumps. G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis,
// 1992), section 5.4.
#pragma once

#include "export/painted_cells.h"
#include "render/draw.h"
#include "run/domain/creased_mesh.h"
#include "surface/cell_filter.h"

#include <memory>
#include <span>

namespace cascade {

/// A surface with its cells, prepared to be drawn several times.
class CellScene {
public:
    /// `mesh` and `cells` must outlive the scene. There must be at least one cell. Throws
    /// std::bad_alloc.
    CellScene(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team);
    ~CellScene();

    /// Draws a picture. At close range, values are filtered first and coloured afterwards. If a
    /// sample covers more than a cell, cells are coloured first, and their colours are blurred by
    /// diffusion to the width of the sample. Sets `round_shadows` of the options. Bumps change the
    /// shading but not the outline. `copies` are drawn on the surface, in the coordinates of
    /// drawn(). If look.displaces is true, heights move the surface, but not the copies. The moved
    /// surface is stored for the next picture with the same heights. The picture does not depend on
    /// the number of threads. Throws std::bad_alloc.
    Image draw(const PaintedCells& look, DrawOptions options, Team& team,
               const Instances* copies = nullptr);

    const DrawnMesh& drawn() const { return drawn_; }

    const CellFilter& filter() const { return filter_; }

private:
    struct Raised;
    const Raised& raise(std::span<const float> heights, Team& team);

    const SurfaceMesh& mesh_;
    const SurfaceCells& cells_;
    DrawnMesh drawn_;
    RayCaster caster_;
    CellFilter filter_;
    /// The surface that heights moved in the last picture with such heights.
    std::unique_ptr<const Raised> raised_;
    float spacing_ = 0;  ///< The distance between cells, in lengths of the mesh.
};

}  // namespace cascade
