// Prepares the surface of a pattern as a mesh for a program that draws it itself, such as the page
// in a browser. The mesh is sent once. Afterwards only one number for each cell is sent at each
// moment.
#pragma once

#include "lang/program/program.h"
#include "run/domain/model_cells.h"
#include "surface/cell_filter.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// The surface below cells: a model, a function of two parameters over a grid, or a body.
struct SurfaceSource {
    std::shared_ptr<const ModelCells> model;
    /// A body below crawling cells, in the script's unit of length. Null if there is none.
    std::shared_ptr<const SurfaceMesh> body;
    std::optional<SurfaceSettings> function;  ///< Given if there is neither a model nor a body.
    Grid grid;

    /// Chooses the surface of a program. `body` is null if the cells have no body. The result is
    /// empty if there is no surface.
    static std::optional<SurfaceSource> of(const Program& program,
                                           std::shared_ptr<const ModelCells> model,
                                           std::shared_ptr<const SurfaceMesh> body);
    /// Whether both sources give the same mesh. Functions are compared at about a hundred points.
    bool is_same_as(const SurfaceSource& other) const;
};

/// A mesh whose triangles are about as fine as the cells. The value at a vertex is a weighted sum
/// of values of cells. Between vertices it is linear.
struct ShownSurface {
    Axis up = Axis::y;
    /// The distance between a model's cells, in the lengths of `positions`. 0 for a function.
    double spacing = 0;
    /// The positions of a model are in the coordinates of scripts. The positions of a function's
    /// surface are in the function's own space. A body is turned like pictures, with z upwards (see
    /// lay_flat()).
    std::vector<Vector3> positions;
    std::vector<Vector3> normals;  ///< Of length 1. A point on a crease is stored as several
                                   ///< vertices with different normals.
    /// For a function: x and y of the vertices in script coordinates. Otherwise empty.
    std::vector<std::array<float, 2>> places;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The weights of vertex v are shares[ends[v − 1]] up to shares[ends[v]]. Cells are numbered in
    /// the order of planes, row by row.
    std::vector<std::uint32_t> ends;
    std::vector<CellShare> shares;
};

/// Makes at most about 2²⁰ triangles. A larger model is replaced by a coarser copy. If the mesh
/// then has fewer points than the model has cells, the pattern is interpolated linearly between the
/// points. Throws std::bad_alloc.
ShownSurface shown_surface(const SurfaceSource& source, Team& team);

}  // namespace cascade
