// The values of an expression in all cells, with their derivatives by all unknowns.
#pragma once

#include "continuation/sparse_rows.h"

namespace cascade::continuation {

/// An expression that is a number in each cell. Values that are the same in all cells are stored
/// once.
struct Part {
    Values values = Values::Zero(1);
    /// A row for each value, and a column for each unknown and for the parameter. Without rows if
    /// the expression depends on none of them.
    SparseRows slopes;

    bool is_constant() const { return slopes.rows() == 0; }
    bool is_uniform() const { return values.size() == 1; }
};

/// The values repeated in `size` cells, unless there are as many already.
Values spread(const Values& values, Index size);
/// The rows multiplied by factors. There may be a single factor or a single row for all cells.
SparseRows scaled(const Values& factors, const SparseRows& rows);
/// Adds rows to a sum that may be empty. Either may be one row for all cells.
void add_rows(SparseRows& sum, SparseRows rows);

Part sum(const Part& a, const Part& b);
Part product(const Part& a, const Part& b);
Part quotient(const Part& a, const Part& b);
Part scaled(const Part& part, double factor);
/// The part multiplied by a matrix whose columns belong to cells. The part must not be uniform.
Part applied(const SparseRows& matrix, const Part& part);

}  // namespace cascade::continuation
