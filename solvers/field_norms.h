// Norms and moments of fields, summed in double precision in one fixed order, so that results
// depend neither on threads nor on vectors.
#pragma once

#include "core/plane.h"

#include <cstdint>
#include <span>

namespace cascade {

// With a mask `inside`, only cells where it is not 0 count. nullptr: all cells count.

/// The number of cells in a row of a mask that count; `width` without a mask (nullptr).
std::int64_t cells_that_count(const std::uint8_t* counts, std::int64_t width);

/// Mean and deviation of a field's cells.
struct FieldMoments {
    double mean = 0;
    double root_mean_square = 0;
    double deviation = 0;  ///< Standard deviation over the cells.
};
FieldMoments moments(const Field& field, const Mask* inside = nullptr);
/// The same for a − b, in double precision.
FieldMoments moments_of_difference(const Field& a, const Field& b, const Mask* inside = nullptr);

/// The root mean square of a field's cells; NaN if one of them is NaN.
double root_mean_square(const Field& field, const Mask* inside = nullptr);

/// The same for a − b, in double precision.
double root_mean_square_of_difference(const Field& a, const Field& b, const Mask* inside = nullptr);

/// The sum of the squares of the first `cells` cells of a row. Threads may share the rows.
double sum_of_squares(const Field& field, std::int64_t row, std::int64_t cells);
/// The root mean square of a field of `cells` cells, from its rows' sums of squares, added in
/// order: the same bits as root_mean_square(). Fields are 0 outside a mask, so whole rows may be
/// summed there.
double root_mean_square(std::span<const double> sums_of_squares, std::int64_t cells);

}  // namespace cascade
