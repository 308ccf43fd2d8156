// How well the fields of constraints were found.
#pragma once

namespace cascade {

/// What is remembered of the solutions of a constraint.
struct SolveReport {
    int most_iterations = 0;
    double largest_rest = 0;  ///< The norm of what remained, over that of what was to be balanced.
    /// Where any constant may be added to the field: the mean that no field balances, over the root
    /// of the mean square of what was to be balanced.
    double largest_mean = 0;
};

}  // namespace cascade
