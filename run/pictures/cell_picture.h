// Pictures of a surface whose cells have values: smooth from near, antialiased from afar, with
// bumps. G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis, 1992), section 5.4.
#pragma once

#include "export/painted_cells.h"
#include "render/draw.h"
#include "run/domain/creased_mesh.h"
#include "surface/cell_filter.h"

#include <memory>
#include <span>

namespace cascade {

/// A surface with its cells, prepared for drawing repeatedly.
class CellScene {
public:
    /// Both must outlive it. There must be at least one cell. Throws std::bad_alloc.
    CellScene(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team);
    ~CellScene();

    /// Colours are those of the filtered values. Where the footprint of a sample is larger than a
    /// cell, the colours of the cells are used, blurred by diffusion to the footprint's width. Sets
    /// `round_shadows` of the options. Bumps change the shading but not the outline. The picture
    /// does not depend on the number of threads. `copies` stand on the surface, in the coordinates
    /// of drawn(). If the look displaces, heights move the surface instead, and copies stay in
    /// place. The raised surface is kept for the next picture with the same heights. Throws
    /// std::bad_alloc.
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
    std::unique_ptr<const Raised> raised_;  ///< By the last heights that displaced it.
    float spacing_ = 0;                     ///< The cells' spacing, in units of the mesh.
};

}  // namespace cascade
