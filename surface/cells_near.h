// The cells at and around points, such as those that stripes start from (G. Turk, thesis, 1992,
// section 4.6.1).
#pragma once

#include "surface/unfolding.h"
#include "surface/voronoi_cells.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Finds the cell whose region holds a place. The mesh and the places of the cells must stay as
/// they are. One object serves one thread at a time.
class CellFinder {
public:
    static constexpr std::uint32_t nothing = 0xffffffff;

    CellFinder(const SurfaceMesh& mesh, std::span<const SurfacePlace> cells);

    /// The nearest cell in the unfolded surface around the place, or in space if none is on the
    /// same component; of equally near ones that of the lowest number. `nothing` without cells.
    std::uint32_t at(const SurfacePlace& place);

private:
    std::span<const std::uint32_t> on(std::uint32_t triangle) const;

    const SurfaceMesh& mesh_;
    std::span<const SurfacePlace> cells_;
    double reach_;                      ///< About twice as far as cells are apart.
    double whole_;                      ///< Farther than anything is.
    std::vector<std::uint32_t> order_;  ///< The cells by their triangles.
    EdgeShapes shapes_;
    Unfolding unfolding_;
};

/// For each point in space the cell at the place of the surface that is nearest to it, or
/// CellFinder::nothing where there is none: without cells, or if the point is not finite.
std::vector<std::uint32_t> cells_at(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                    std::span<const Vector3d> points);

/// Whether each cell is no farther along the surface than `distance`, in units of the model, from
/// the places nearest to the points: one byte a cell, 1 or 0. Points that are not finite count
/// for nothing. Means nothing if `cancel` became true.
std::vector<std::uint8_t> cells_within(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                       std::span<const Vector3d> points, double distance,
                                       const std::atomic<bool>& cancel);

}  // namespace cascade
