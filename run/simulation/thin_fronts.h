// Finds fronts that are thinner than a cell. The grid may hold such fronts in place.
#pragma once

#include "core/plane.h"
#include "core/spread.h"

namespace cascade {

struct Fronts {
    double all = 0, thin = 0;
    double speed = 0;  ///< The sum of the speeds of thin fronts, in cells per unit of time.

    bool are_thin() const;  ///< Whether almost all fronts are thin.
};

/// Finds the fronts of a species whose values have the spread `spread`. `rates` are used for the
/// speed of fronts, and may be null.
Fronts fronts_of(const Field& values, const Field* rates, const Spread& spread);

}  // namespace cascade
