// The surface of a pattern as a mesh for a program that draws it itself, such as a page: it is sent
// once, and then one number per cell for each moment.
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

/// What cells lie on: a model, a surface of two parameters under a grid, or a body in its volume.
struct SurfaceSource {
    std::shared_ptr<const ModelCells> model;
    std::shared_ptr<const SurfaceMesh>
        body;  ///< Of cells that crawl on one, in lengths of scripts.
    std::optional<SurfaceSettings> function;  ///< Without both.
    Grid grid;

    /// `body` is null without one. Nothing if there is no surface.
    static std::optional<SurfaceSource> of(const Program& program,
                                           std::shared_ptr<const ModelCells> model,
                                           std::shared_ptr<const SurfaceMesh> body);
    /// Do both give the same mesh? Functions are compared at some hundred places.
    bool is_same_as(const SurfaceSource& other) const;
};

/// Triangles about as fine as the cells, and how much of each cell's value a vertex shows: between
/// vertices values are linear.
struct ShownSurface {
    Axis up = Axis::y;
    double spacing = 0;  ///< Of a model's cells, in the same lengths; 0 for a function.
    /// As scripts have them; of a function, as it gives them; of a body, laid flat as in pictures.
    std::vector<Vector3> positions;
    std::vector<Vector3> normals;  ///< Of length 1; a point on a crease is several vertices.
    /// Of a function: x and y of the vertices as scripts have them. Else empty.
    std::vector<std::array<float, 2>> places;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// Vertex v shows shares[ends[v − 1]] up to shares[ends[v]]. Cells are numbered as they lie in
    /// planes, row after row.
    std::vector<std::uint32_t> ends;
    std::vector<CellShare> shares;
};

/// At most about 2²⁰ triangles: larger models are shown by a coarse copy, and the pattern on more
/// cells by linear interpolation between fewer places. Throws std::bad_alloc.
ShownSurface shown_surface(const SurfaceSource& source, Team& team);

}  // namespace cascade
