// The flat states of a stage: values of the species at which all rates are 0.
#pragma once

#include "analysis/local_rates.h"

#include <optional>
#include <vector>

namespace cascade::analysis {

struct FlatState {
    Vector species;
    /// Whether Newton's method found it from the script's own starting values.
    bool is_from_start = false;
};

struct FlatStates {
    std::vector<FlatState> found;  ///< The state of the starting values first, if there is one.
    /// Combinations of species whose total the reaction conserves, as rows. If there are any, flat
    /// states come in families, and these have the totals of the starting values.
    Matrix conserved;
};

/// Finds states by Newton's method, from the starting values and then from other points, with known
/// states repelling it (P. E. Farrell, A. Birkisson, S. W. Funke, "Deflation techniques for finding
/// distinct solutions of nonlinear partial differential equations", 2015). Omits states excluded by
/// the system's invariants. May miss states.
FlatStates flat_states(const LocalRates& rates);

/// The state that Newton's method reaches from given values. Empty if it reaches none.
std::optional<Vector> flat_state_near(const LocalRates& rates, const Vector& species,
                                      const Matrix& conserved);

/// The combinations of species that the reaction conserves for all values.
Matrix conserved_totals(const LocalRates& rates);

}  // namespace cascade::analysis
