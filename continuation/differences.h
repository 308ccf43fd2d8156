// The differences of lang/program/stencils.h as sparse matrices over a padded grid, and sums over
// the links of a model's cells.
#pragma once

#include "continuation/padded_grid.h"

#include <map>
#include <tuple>

namespace cascade::continuation {

/// The cells that a difference reads, with their weights. At the border of a mask, neighbours
/// outside are replaced by values beyond the border (lang/lower/lower_mask.cpp).
struct Reads {
    SparseRows all;  ///< All reads, for values that are mirrored at the border.
    /// The reads of cells, of values beyond the border, and of values beyond two borders. No rows
    /// if no position is outside of the domain.
    SparseRows inside, once, twice;
};

/// Makes each matrix once.
class Differences {
public:
    explicit Differences(const PaddedGrid& grid) : grid_(grid) {}

    const PaddedGrid& grid() const { return grid_; }

    /// A difference in the cells of the grid. Its results in the halo are copied from cells as
    /// `beyond` says.
    const Reads& in_cells(Difference difference, int first, int second, const Boundaries& beyond);
    /// The value of the cell at an offset.
    const Reads& beside(Offset offset, const Boundaries& beyond);

    /// Values at the faces along an axis. The row of a cell is for the face after this cell, so the
    /// faces before the first cells are in the rows of halo cells. `difference` is `average` or
    /// `across`.
    const Reads& at_faces(Difference difference, int axis);
    /// The central difference along another axis at each face, averaged over both cells of the
    /// face.
    const Reads& along_faces(int axis, int component);
    /// The difference of the values at both faces of a cell, divided by the spacing.
    const SparseRows& between_faces(int axis, const Boundaries& beyond);
    /// For each cell, 1 if the face after it, along the axis of `side`, lies on this side of the
    /// grid, otherwise 0.
    Values on_side(int side) const;
    /// For each cell, 1 if the face after it along `axis` lies between two cells of the domain,
    /// otherwise 0.
    Values within_border(int axis) const;
    /// Σ w (f_j − f_i) over the links of each cell.
    const SparseRows& over_links();
    /// Σ g (f_j − f_i) over the links of each cell, where g are the weights of a component of the
    /// gradient.
    const SparseRows& gradient_over_links(int component);

private:
    using Key = std::tuple<int, int, int, int>;
    using Entries = std::vector<Eigen::Triplet<double>>;
    struct Taking;
    SparseRows made(const Entries& entries) const;
    Reads made(const Taking& taking) const;
    SparseRows linked(const double* weights) const;
    bool is_face(Index cell, int axis) const;

    const PaddedGrid& grid_;
    std::map<Key, Reads> known_;
    std::map<Key, SparseRows> others_;
};

}  // namespace cascade::continuation
