// Numbers that sum up fields: summed in double precision in one fixed order, so that results depend
// neither on threads nor on vectors.
#pragma once

#include "core/plane.h"

namespace cascade {

// With a mask `inside` the cells count where it is not 0; without one (nullptr) all.

/// Mean and spread of a field's cells.
struct FieldMoments {
    double mean = 0;
    double root_mean_square = 0;
    double deviation = 0;  ///< Standard deviation over the cells.
};
FieldMoments moments(const Field& field, const Mask* inside = nullptr);

/// The root mean square of a field's cells; NaN where one is NaN.
double root_mean_square(const Field& field, const Mask* inside = nullptr);

/// The root mean square of a − b.
double root_mean_square_of_difference(const Field& a, const Field& b,
                                      const Mask* inside = nullptr);

}  // namespace cascade
