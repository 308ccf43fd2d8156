// Aggregates over all cells of a plane: sums, means, smallest and largest values.
//
// Each row is reduced to one number in a fixed order. Then the numbers of the rows are combined in
// pairs, the results are combined in pairs again, and so on. The order depends only on the grid, so
// the bits of the result are the same for any number of threads and any vector width. Sums are in
// binary64. The caller rounds the result.
#pragma once

#include <cstdint>
#include <span>

namespace cascade {

enum class ReductionKind : std::uint8_t { sum, mean, least, largest };

/// Reduces `count` cells of a row, at least one. The smallest and the largest value are NaN if any
/// cell is NaN.
template <typename Number>
double reduce_row(ReductionKind kind, const Number* cells, std::int64_t count);

/// Reduces the results of all rows (at least one) to one. `cells` is the number of cells in all
/// rows. Overwrites `rows`.
double reduce_rows(ReductionKind kind, std::span<double> rows, std::int64_t cells);

}  // namespace cascade
