// The values of an expression in all cells, with their derivatives by all unknowns.
#pragma once

#include "continuation/sparse_rows.h"

namespace cascade::continuation {

/// An expression that is a number in each cell. Values that are the same in all cells are stored
/// once.
struct Part {
    Values values = Values::Zero(1);
    /// One row for each value, and one column for each unknown and for the parameter. No rows if
    /// the expression depends on none of them.
    SparseRows slopes;

    bool is_constant() const { return slopes.rows() == 0; }
    bool is_uniform() const { return values.size() == 1; }
};

/// Repeats a single value in `size` cells. Returns several values unchanged.
Values spread(const Values& values, Index size);
/// Multiplies rows by factors. A single factor or a single row applies to all cells.
SparseRows scaled(const Values& factors, const SparseRows& rows);
/// Adds rows to a sum, which may be empty. In both, a single row stands for all cells.
void add_rows(SparseRows& sum, SparseRows rows);

Part sum(const Part& a, const Part& b);
Part product(const Part& a, const Part& b);
Part quotient(const Part& a, const Part& b);
Part scaled(const Part& part, double factor);
/// The part multiplied by a matrix whose columns belong to cells. The part must not be uniform.
Part applied(const SparseRows& matrix, const Part& part);

}  // namespace cascade::continuation
