// The accuracy with which the fields of constraints were found.
#pragma once

namespace cascade {

/// Statistics of a constraint's solutions.
struct SolveReport {
    int most_iterations = 0;
    /// The norm of the residual, divided by the norm of the constraint with the field 0: the
    /// largest such quotient of all solutions.
    double largest_rest = 0;
    /// The mean of the constraint if its field is 0, divided by the constraint's root mean square:
    /// the largest such quotient of all solutions. No choice of the field removes this mean. Set
    /// only for fields to which any constant may be added.
    double largest_mean = 0;
};

}  // namespace cascade
