// The flat states of a stage: values of the species at which no rate changes them.
#pragma once

#include "analysis/local_rates.h"

#include <optional>
#include <vector>

namespace cascade::analysis {

struct FlatState {
    Vector species;
    /// Was it found by Newton's method from the script's own starting values?
    bool is_from_start = false;
};

struct FlatStates {
    std::vector<FlatState> found;  ///< That of the starting values first, if there is one.
    /// Combinations of species whose total the reaction keeps, as rows; none has no rows. Then
    /// flat states come in families, and these are those with the totals of the starting values.
    Matrix conserved;
};

/// By Newton's method, from the starting values and then from other places, where states that are
/// known repel it (P. E. Farrell, A. Birkisson, S. W. Funke, "Deflation techniques for finding
/// distinct solutions of nonlinear partial differential equations", 2015). States that the
/// system's invariants exclude are left out. That a state is not found does not prove that there is
/// none.
FlatStates flat_states(const LocalRates& rates);

/// The state that Newton's method reaches from given values; empty if it reaches none.
std::optional<Vector> flat_state_near(const LocalRates& rates, const Vector& species,
                                      const Matrix& conserved);

/// The combinations of species that the reaction keeps whatever their values are.
Matrix conserved_totals(const LocalRates& rates);

}  // namespace cascade::analysis
