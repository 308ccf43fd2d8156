// How well the fields of constraints were found.
#pragma once

namespace cascade {

/// Statistics of a constraint's solutions.
struct SolveReport {
    int most_iterations = 0;
    double largest_rest = 0;  ///< The residual's norm over the constraint's without the field.
    /// The constraint's mean without the field, over its root mean square. No field balances it.
    /// Only for fields to which any constant may be added.
    double largest_mean = 0;
};

}  // namespace cascade
