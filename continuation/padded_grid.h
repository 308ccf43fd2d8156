// A grid with a halo of one cell on both sides of every axis that has several cells.
//
// Values of expressions are stored for all cells of the padded grid. So a value beyond a side is a
// number like any other, and the rules of sides need no special derivatives. The cells of a model
// have links in place of axes, and no halo.
#pragma once

#include "continuation/domain_cells.h"
#include "continuation/sparse_rows.h"
#include "core/grid.h"
#include "lang/program/stencils.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade::continuation {

class PaddedGrid {
public:
    explicit PaddedGrid(const DomainCells& cells);

    const GridAxes& axes() const { return axes_; }
    double spacing() const { return spacing_; }
    /// The numbers of cells of the padded grid and of the domain.
    Index size() const { return size_; }
    Index cell_count() const { return static_cast<Index>(cells_.size()); }
    /// The numbers of all positions of the grid in the padded grid. x varies fastest, z slowest.
    const std::vector<Index>& positions() const { return positions_; }
    /// Whether some positions of the grid are not cells of the domain.
    bool has_outside() const { return has_outside_; }
    /// Whether a cell of the padded grid, or the cell from which the domain's boundary copies it,
    /// belongs to the domain.
    bool is_inside(Index padded) const { return inside_[static_cast<std::size_t>(padded)]; }
    /// The links of a model's cells. Null on grids.
    const Links* links() const { return links_; }
    /// The numbers of the domain's cells in the padded grid. x varies fastest, z slowest.
    const std::vector<Index>& cells() const { return cells_; }
    /// The number of cells along an axis.
    std::int64_t length(int axis) const { return lengths_[static_cast<std::size_t>(axis)]; }
    /// The difference between the numbers of a cell and of the cell at an offset.
    Index shift(Offset offset) const;
    /// The position of a cell of the padded grid along an axis: −1 or `length` in the halo.
    std::int64_t position(Index padded, int axis) const;
    /// A cell of the halo. Its neighbour `inner` lies next to it along the last axis on which the
    /// halo cell is beyond a side. In halo(), each cell comes after its `inner`.
    struct HaloCell {
        Index cell = 0, inner = 0;  ///< `inner` is the next cell inwards.
        Index opposite = 0;         ///< The cell at the other end of the axis.
        int side = 0;               ///< The number of a Side.
        Index beside = 0;           ///< The cell of the grid at which the side's value is taken.
    };
    const std::vector<HaloCell>& halo() const { return halo_; }

    /// For each cell of the padded grid, the cell from which its value is copied if all sides are
    /// periodic or mirrored.
    std::vector<Index> sources(const Boundaries& boundary) const;

private:
    void find_halo();
    void find_cells(const DomainCells& cells);

    GridAxes axes_;
    double spacing_;
    std::array<std::int64_t, 3> lengths_{}, padded_{}, strides_{};
    Index size_ = 0;
    std::vector<Index> positions_, cells_;
    std::vector<bool> inside_;
    bool has_outside_ = false;
    const Links* links_ = nullptr;
    std::vector<HaloCell> halo_;
};

}  // namespace cascade::continuation
