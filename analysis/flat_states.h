// The flat states of a stage: values of the species at which all rates are 0.
#pragma once

#include "analysis/local_rates.h"

#include <optional>
#include <vector>

namespace cascade::analysis {

struct FlatState {
    Vector species;
    /// Whether Newton's method found the state from the script's own starting values.
    bool is_from_start = false;
};

struct FlatStates {
    /// The flat states. If Newton's method finds one from the starting values, it is the first.
    std::vector<FlatState> found;
    /// Each row is a combination of species whose total the reaction conserves. If there are such
    /// combinations, flat states come in families, and `found` has the members of these families
    /// with the totals of the starting values.
    Matrix conserved;
};

/// Finds states by Newton's method, from the starting values and then from other points. Known
/// states repel the search (P. E. Farrell, A. Birkisson, S. W. Funke, "Deflation techniques for
/// finding distinct solutions of nonlinear partial differential equations", 2015). Omits states
/// that the system's invariants exclude. May miss states.
FlatStates flat_states(const LocalRates& rates);

/// The flat state that Newton's method reaches from the values `species`. Empty if it reaches none.
std::optional<Vector> flat_state_near(const LocalRates& rates, const Vector& species,
                                      const Matrix& conserved);

/// The combinations of species that the reaction conserves for all values of the species.
Matrix conserved_totals(const LocalRates& rates);

}  // namespace cascade::analysis
