// The surface of a pattern as a mesh for a program that draws it itself, such as a page: sent once,
// followed by one number per cell for each moment.
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

/// The surface below cells: a model, a function of two parameters under a grid, or a body.
struct SurfaceSource {
    std::shared_ptr<const ModelCells> model;
    std::shared_ptr<const SurfaceMesh> body;  ///< Below crawling cells, in script lengths.
    std::optional<SurfaceSettings> function;  ///< Without a model and a body.
    Grid grid;

    /// `body` is null without one. Empty if there is no surface.
    static std::optional<SurfaceSource> of(const Program& program,
                                           std::shared_ptr<const ModelCells> model,
                                           std::shared_ptr<const SurfaceMesh> body);
    /// Whether both give the same mesh. Compares functions at about a hundred points.
    bool is_same_as(const SurfaceSource& other) const;
};

/// Triangles about as fine as the cells, and each vertex's shares of the cells' values. Between
/// vertices values are linear.
struct ShownSurface {
    Axis up = Axis::y;
    double spacing = 0;  ///< The spacing of a model's cells, in the same lengths. 0 for a function.
    /// In script coordinates, for a function in its own, for a body laid flat as in pictures.
    std::vector<Vector3> positions;
    std::vector<Vector3> normals;  ///< Of length 1. A point on a crease is several vertices.
    /// For a function: x and y of the vertices in script coordinates. Otherwise empty.
    std::vector<std::array<float, 2>> places;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// Vertex v shows shares[ends[v − 1]] up to shares[ends[v]]. Cells are numbered in the order of
    /// planes, row after row.
    std::vector<std::uint32_t> ends;
    std::vector<CellShare> shares;
};

/// At most about 2²⁰ triangles: larger models are shown by a coarse copy, and the pattern on more
/// cells by linear interpolation between fewer points. Throws std::bad_alloc.
ShownSurface shown_surface(const SurfaceSource& source, Team& team);

}  // namespace cascade
