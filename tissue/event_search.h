// Finds when cells divide and die within a step.
#pragma once

#include "core/result.h"
#include "solvers/pass_runner.h"
#include "tissue/division.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"
#include "tissue/value_runner.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// The cubic through the values and the rates at both ends of a step (Hermite), which differs from
/// the solution by a term in step⁴. At part 1 it is the new state, bit for bit, if all is finite.
struct StepCubic {
    std::vector<Field>&old_state, &new_state;
    const std::vector<Field>&old_rates, &new_rates;
    StepMoment moment;  ///< The old state's moment. `length` is the step's.

    /// The moment after a part of the step.
    StepMoment moment_after(double part) const;
    /// The species of one cell after a part of the step.
    std::vector<double> values(std::int64_t element, double part) const;
    /// Sets the species of one cell to these values.
    void put(std::vector<Field>& state, std::int64_t element, double part) const;
    /// Sets the species of all cells. `state` may be the new one itself.
    void put_all(std::vector<Field>& state, double part) const;
};

/// The cells for which conditions hold at a state, in the order of their numbers. A cell that dies
/// does not divide. `among`: the cells to check, or all if empty.
std::vector<CellEvent> events_at(const TissueRules::Conditions& conditions,
                                 std::vector<Field>& state, const Tissue& tissue,
                                 const StepMoment& moment, ValueRunner& runner,
                                 std::span<const std::uint32_t> among = {});

/// Makes lists that are valid for a state at which values of links will be evaluated.
using Reach = std::function<Result<void>(const std::vector<Field>& state)>;

/// The events within a step, in the order of parts, then of numbers: the cells for which a
/// condition holds at its end, and the first moments at which it does, to 2^-20 of the step (2^-16
/// in single precision). Conditions whose values go smoothly through 0 take about five evaluations,
/// others up to 24. Conditions that read other cells or the time are only followed to the first
/// moment, and only the events of that moment are returned. Conditions must not hold at the
/// beginning. Fails if `reach` does.
Result<std::vector<CellEvent>> events_within(const TissueRules::Conditions& conditions,
                                             const StepCubic& cubic, const Tissue& tissue,
                                             ValueRunner& runner, const Reach& reach);

}  // namespace cascade
