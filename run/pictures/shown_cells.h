// Crawling cells for a program that draws them itself, such as a page: a few meshes, and the
// positions of their copies.
#pragma once

#include "mesh/instances.h"
#include "picture/image.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/shown_surface.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The cells of a moment.
struct ShownCells {
    std::size_t count = 0;  ///< All cells, including those not drawn.
    std::vector<TriangleMesh> meshes;
    /// By mesh: its copies are placements[ends[k − 1]] up to placements[ends[k]]. Lengths are in
    /// script units. Without a model everything lies flat, as in pictures.
    std::vector<std::uint32_t> ends;
    std::vector<Placement> placements;
    /// By placement: the column of its cell in the row of values.
    std::vector<std::uint32_t> cells;
    Colour skin;      ///< The surface below them, sRGB.
    Vector3d extent;  ///< Without a model: the size of the plane, whose z is 0, or of the box.
    bool is_on_model = false, is_on_body = false;
};

/// `surface` is null on a plane and in a box. Throws std::bad_alloc.
ShownCells shown_cells(const DrawnCells& cells, const SurfaceSource* surface);

}  // namespace cascade
