// Prepares the surface of a pattern as a mesh for a program that draws it itself, such as the page
// in a browser. The mesh is sent only once. Afterwards, one number for each cell is sent at each
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
    /// A body below crawling cells, in the script's unit of length. Null if there is no body.
    std::shared_ptr<const SurfaceMesh> body;
    /// Given only if there is neither a model nor a body.
    std::optional<SurfaceSettings> function;
    Grid grid;

    /// Finds the surface of a program. `body` is null if the cells have no body. Returns an empty
    /// optional if there is no surface.
    static std::optional<SurfaceSource> of(const Program& program,
                                           std::shared_ptr<const ModelCells> model,
                                           std::shared_ptr<const SurfaceMesh> body);
    /// Whether both sources give the same mesh. Functions are compared at about a hundred points.
    bool is_same_as(const SurfaceSource& other) const;
};

/// A mesh whose triangles are about as fine as the cells. The value at a vertex is a weighted sum
/// of values of cells. Between vertices, values are linear.
struct ShownSurface {
    Axis up = Axis::y;
    /// The distance between a model's cells, in the unit of `positions`. 0 for a surface given by a
    /// function.
    double spacing = 0;
    /// The positions of a model are in the coordinates of scripts. The positions of a function's
    /// surface are in the function's own space. A body is turned as in pictures, with z upwards
    /// (see lay_flat()).
    std::vector<Vector3> positions;
    /// The normals of the vertices, of length 1. A point on a crease is stored as several vertices
    /// with different normals.
    std::vector<Vector3> normals;
    /// For a surface given by a function: x and y of the vertices in script coordinates. Otherwise
    /// empty.
    std::vector<std::array<float, 2>> places;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// Vertex v has the weights shares[j] with ends[v − 1] ≤ j < ends[v]. Cells are numbered in the
    /// order of planes, row by row.
    std::vector<std::uint32_t> ends;
    std::vector<CellShare> shares;
};

/// Makes at most about 2²⁰ triangles. A larger model is replaced by a coarser copy. If the mesh
/// then has fewer points than the model has cells, the pattern is interpolated linearly between the
/// points. Throws std::bad_alloc.
ShownSurface shown_surface(const SurfaceSource& source, Team& team);

}  // namespace cascade
