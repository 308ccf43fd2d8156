// Finds the cell whose region contains a position.
#pragma once

#include "surface/unfolding.h"
#include "surface/voronoi_cells.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Finds cells by position. The mesh and the cells must outlive the finder unchanged. Not
/// thread-safe.
class CellFinder {
public:
    static constexpr std::uint32_t nothing = 0xffffffff;

    CellFinder(const SurfaceMesh& mesh, std::span<const SurfacePlace> cells);

    /// The cell that is nearest in the unfolded surface around the position, or nearest in space if
    /// the position's component has no cell. If several cells are equally near, the cell with the
    /// lowest index. `nothing` if there are no cells.
    std::uint32_t at(const SurfacePlace& place);

private:
    std::span<const std::uint32_t> on(std::uint32_t triangle) const;

    const SurfaceMesh& mesh_;
    std::span<const SurfacePlace> cells_;
    double reach_;                      ///< About twice the spacing of cells.
    double whole_;                      ///< More than the length of the longest path.
    std::vector<std::uint32_t> order_;  ///< The cells sorted by triangle.
    EdgeShapes shapes_;
    Unfolding unfolding_;
};

}  // namespace cascade
