// Norms and moments of fields, summed in double precision in one fixed order, so that results are
// the same bit for bit with any number of threads and any vector width.
#pragma once

#include "core/plane.h"

#include <cstdint>
#include <span>

namespace cascade {

// In all functions, `inside` is a mask. Only cells where the mask is not 0 count. Without a mask
// (nullptr), all cells count.

/// The number of cells in a row that count. `counts` is the row's mask, or null if all `width`
/// cells count.
std::int64_t cells_that_count(const std::uint8_t* counts, std::int64_t width);

/// Mean and deviation of a field's cells.
struct FieldMoments {
    double mean = 0;
    double root_mean_square = 0;
    double deviation = 0;  ///< Standard deviation over the cells.
};
FieldMoments moments(const Field& field, const Mask* inside = nullptr);
/// The result of moments_of() for the difference a − b, computed in double precision.
FieldMoments moments_of_difference(const Field& a, const Field& b, const Mask* inside = nullptr);

/// The root mean square of a field's cells; NaN if one of the cells is NaN.
double root_mean_square(const Field& field, const Mask* inside = nullptr);

/// The root mean square of the difference a − b, computed in double precision.
double root_mean_square_of_difference(const Field& a, const Field& b, const Mask* inside = nullptr);

/// The sum of the squares of the first `cells` cells of a row. Threads may share the rows.
double sum_of_squares(const Field& field, std::int64_t row, std::int64_t cells);
/// The root mean square of a field of `cells` cells, from the sums of squares of its rows, which
/// are added in order. Equals root_mean_square() of the field bit for bit. Outside a mask fields
/// are 0, so whole rows may be summed.
double root_mean_square(std::span<const double> sums_of_squares, std::int64_t cells);

}  // namespace cascade
