// The state of a tissue at any moment of a step that has been taken.
#pragma once

#include "solvers/pass_runner.h"
#include "tissue/tissue.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The cubic through the values and the rates at both ends of a step (Hermite), which differs from
/// the solution by a term in step⁴. At part 1 it is the new state, bit for bit, if all is finite.
struct StepCubic {
    std::vector<Field>&old_state, &new_state;
    const std::vector<Field>&old_rates, &new_rates;
    StepMoment moment;  ///< Of the old state; `length` is that of the step.

    /// The moment after a part of the step.
    StepMoment moment_after(double part) const;
    /// The species of one cell after a part of the step.
    std::vector<double> values(std::int64_t element, double part) const;
    /// Sets the species of one cell to those,
    void put(std::vector<Field>& state, std::int64_t element, double part) const;
    /// or the species of all cells. The state may be the new one itself.
    void put_all(std::vector<Field>& state, double part) const;
};

}  // namespace cascade
