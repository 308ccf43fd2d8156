// Computes the material of a grid that is bent into a surface, at any point of the surface.
#pragma once

#include "mesh/triangle_mesh.h"
#include "render/draw.h"
#include "run/pictures/material.h"
#include "run/pictures/surface_lattice.h"
#include "surface/parameter_surface.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The numbers of cells of a grid, row by row, for pictures of the grid on a surface.
struct GridMaterial {
    Material material;  ///< Each part of the material has a number for each cell, or is empty.
    std::int64_t columns = 0, rows = 0;
    bool is_periodic_x = false, is_periodic_y = false;
    /// The unit of the heights, in lengths of the surface. If empty, it is the side of a square
    /// with the mean area of a cell.
    std::optional<double> unit = {};
    /// The number of parts into which each cell of the script is divided along a side.
    std::int64_t detail = 1;
};

/// Computes gloss, emitted light, opacity and bumps where a ray hits the surface. Numbers are
/// interpolated linearly between the centres of cells.
class SurfaceFinish {
public:
    /// `mesh` is a mesh of the surface. Heights raise the surface away from the middle of the mesh.
    SurfaceFinish(const SurfaceFunction& surface, const GridMaterial& grid,
                  const TriangleMesh& mesh);

    bool is_translucent() const { return !material_.parts[MaterialPart::opacity].empty(); }

    /// Sets those parts of a look that the material has. `x` and `y` are the cells around the
    /// point.
    void add_to(Look& look, const BetweenCells& x, const BetweenCells& y) const;
    /// Returns the opacity at a point. If all cells have the opacity 0 or 1, the result is 0 or 1,
    /// too.
    float opacity(const BetweenCells& x, const BetweenCells& y) const;

private:
    void measure_slopes(const SurfaceFunction& surface, const GridMaterial& grid, double unit);

    template <typename Number>
    Number between(const std::vector<Number>& cells, const BetweenCells& x,
                   const BetweenCells& y) const {
        const auto at = [&](std::int64_t column, std::int64_t row) {
            return cells[static_cast<std::size_t>(row * columns_ + column)];
        };
        const Number above = at(x.first, y.first) * (1 - x.part) + at(x.second, y.first) * x.part;
        const Number below = at(x.first, y.second) * (1 - x.part) + at(x.second, y.second) * x.part;
        return above * (1 - y.part) + below * y.part;
    }

    Material material_;
    std::int64_t columns_;
    bool is_cut_ = false;          ///< Whether all cells have the opacity 0 or 1.
    bool is_flipped_ = false;      ///< Whether the normals of the mesh point towards its middle.
    std::vector<Vector3> slopes_;  ///< The gradient of the height along the surface in each cell.
};

}  // namespace cascade
