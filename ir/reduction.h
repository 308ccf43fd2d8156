// Aggregates over all cells of a plane: sums, means, smallest and largest values.
//
// Each row is reduced to one number in a fixed order. Then rows are combined in pairs, pairs in
// pairs, and so on. This tree only depends on the grid, so the bits of the result are the same for
// any number of threads and any vector width. Sums are in binary64. The caller rounds the result.
#pragma once

#include <cstdint>
#include <span>

namespace cascade {

enum class ReductionKind : std::uint8_t { sum, mean, least, largest };

/// Reduces `count` cells, at least one. Smallest and largest are NaN if a cell is NaN.
template <typename Number>
double reduce_row(ReductionKind kind, const Number* cells, std::int64_t count);

/// Reduces the results of all rows, at least one, for a total of `cells`. Overwrites `rows`.
double reduce_rows(ReductionKind kind, std::span<double> rows, std::int64_t cells);

}  // namespace cascade
