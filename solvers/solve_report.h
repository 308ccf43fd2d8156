// How well the fields of constraints were found.
#pragma once

namespace cascade {

/// Statistics of a constraint's solutions.
struct SolveReport {
    int most_iterations = 0;
    double largest_rest = 0;  ///< The residual's norm over the constraint's without the field.
    /// If any constant may be added to the field: the mean of the constraint without the field,
    /// which no field balances, over its root mean square.
    double largest_mean = 0;
};

}  // namespace cascade
