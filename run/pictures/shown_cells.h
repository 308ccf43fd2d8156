// Prepares crawling cells for a program that draws the cells itself, such as the page in a browser.
// The result is a few meshes and the positions of their copies.
#pragma once

#include "mesh/instances.h"
#include "picture/image.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/shown_surface.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The cells at one moment. Lengths are in the script's unit. Without a model, all positions are
/// turned as in pictures, with z upwards (see lay_flat()).
struct ShownCells {
    std::size_t count = 0;  ///< The number of all cells, including cells that are not drawn.
    std::vector<TriangleMesh> meshes;
    /// The copies of mesh k are placements[j] with ends[k − 1] ≤ j < ends[k]. For k = 0, j begins
    /// at 0.
    std::vector<std::uint32_t> ends;
    std::vector<Placement> placements;
    /// For each placement, the column of its cell in the row of values.
    std::vector<std::uint32_t> cells;
    Colour skin;  ///< The colour of the surface below the cells, in sRGB.
    /// Without a model: the size of the plane (z = 0) or of the box in which the cells crawl.
    Vector3d extent;
    bool is_on_model = false, is_on_body = false;
};

/// `surface` is null if the cells crawl on a plane or in a box. Throws std::bad_alloc.
ShownCells shown_cells(const DrawnCells& cells, const SurfaceSource* surface);

}  // namespace cascade
