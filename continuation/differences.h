// The differences of lang/program/stencils.h as sparse matrices over a padded grid.
#pragma once

#include "continuation/padded_grid.h"

#include <map>
#include <tuple>

namespace cascade::continuation {

/// Makes each matrix once.
class Differences {
public:
    explicit Differences(const PaddedGrid& grid) : grid_(grid) {}

    const PaddedGrid& grid() const { return grid_; }

    /// A difference in the cells of the grid. Beyond sides its values are copied as `beyond` says.
    const SparseRows& in_cells(Difference difference, int first, int second,
                               const Boundaries& beyond);
    /// The value in the cell at an offset.
    const SparseRows& beside(Offset offset, const Boundaries& beyond);

    /// Values at the faces along an axis. The row of a cell belongs to the face after it. Faces
    /// before the first cells belong to cells of the halo. `difference` is `average` or `across`.
    const SparseRows& at_faces(Difference difference, int axis);
    /// The mean over both cells of a face of the central difference along another axis.
    const SparseRows& along_faces(int axis, int component);
    /// The difference of the values at both faces of a cell, divided by the spacing.
    const SparseRows& between_faces(int axis, const Boundaries& beyond);
    /// Whether each cell's face after it along `axis` lies on a side of the grid: 1 or 0.
    Values on_side(int side) const;

private:
    using Key = std::tuple<int, int, int, int>;
    using Entries = std::vector<Eigen::Triplet<double>>;
    SparseRows made(const Entries& entries) const;
    bool is_face(Index cell, int axis) const;

    const PaddedGrid& grid_;
    std::map<Key, SparseRows> known_;
};

}  // namespace cascade::continuation
