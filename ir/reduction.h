// Aggregates over all cells of a plane: sums, means, smallest and largest values.
//
// Each row is reduced to one number in a fixed order, then rows are taken together in pairs, pairs
// in pairs, and so on: the tree depends on the grid alone, so the result is the same bits with any
// number of threads and any width of vectors. Sums are in binary64; who asks rounds the result.
#pragma once

#include <cstdint>
#include <span>

namespace cascade {

enum class ReductionKind : std::uint8_t { sum, mean, least, largest };

/// Reduces `count` cells, at least one. Smallest and largest are NaN where one cell is NaN.
template <typename Number>
double reduce_row(ReductionKind kind, const Number* cells, std::int64_t count);

/// Reduces the numbers of all rows, in order, at least one; `cells` is how many cells they stand
/// for. Overwrites `rows`.
double reduce_rows(ReductionKind kind, std::span<double> rows, std::int64_t cells);

}  // namespace cascade
