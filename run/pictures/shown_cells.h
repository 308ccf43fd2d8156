// Prepares crawling cells for a program that draws them itself, such as the page in a browser: a
// few meshes, and the positions of their copies.
#pragma once

#include "mesh/instances.h"
#include "picture/image.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/shown_surface.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The cells at one moment.
struct ShownCells {
    std::size_t count = 0;  ///< The number of all cells, including cells that are not drawn.
    std::vector<TriangleMesh> meshes;
    /// The copies of mesh k are placements[ends[k − 1]] up to placements[ends[k]]. Lengths are in
    /// the script's unit. Without a model everything is turned like pictures, with z upwards (see
    /// lay_flat()).
    std::vector<std::uint32_t> ends;
    std::vector<Placement> placements;
    /// For each placement, the column of its cell in the row of values.
    std::vector<std::uint32_t> cells;
    Colour skin;      ///< The colour of the surface below the cells, in sRGB.
    Vector3d extent;  ///< Without a model: the size of the plane (with z = 0) or of the box.
    bool is_on_model = false, is_on_body = false;
};

/// `surface` is null if the cells crawl on a plane or in a box. Throws std::bad_alloc.
ShownCells shown_cells(const DrawnCells& cells, const SurfaceSource* surface);

}  // namespace cascade
