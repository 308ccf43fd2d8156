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

/// The cubic through the values and the rates at both ends of a step (Hermite). It differs from the
/// solution by a term in step⁴. At the end of the step it equals the new state bit for bit, if all
/// values and rates are finite.
struct StepCubic {
    std::vector<Field>&old_state, &new_state;
    const std::vector<Field>&old_rates, &new_rates;
    StepMoment moment;  ///< The old state's moment. Its `length` is the length of the step.

    /// The moment after this fraction of the step.
    StepMoment moment_after(double part) const;
    /// The species of one cell after this fraction of the step.
    std::vector<double> values(std::int64_t element, double part) const;
    /// Sets the species of one cell to values().
    void put(std::vector<Field>& state, std::int64_t element, double part) const;
    /// Sets the species of all cells to values(). `state` may be the new state of the step.
    void put_all(std::vector<Field>& state, double part) const;
};

/// The events at a state: divisions and deaths of the cells whose conditions hold, in the order of
/// the cells' numbers. A cell that dies does not divide. Checks only the cells in `among`, or all
/// cells if `among` is empty.
std::vector<CellEvent> events_at(const TissueRules::Conditions& conditions,
                                 std::vector<Field>& state, const Tissue& tissue,
                                 const StepMoment& moment, ValueRunner& runner,
                                 std::span<const std::uint32_t> among = {});

/// Brings the lists of neighbours up to date for `state`. Must be called before any formula that
/// reads links is evaluated in this state.
using Reach = std::function<Result<void>(const std::vector<Field>& state)>;

/// The events within a step, sorted by moment, then by the cells' numbers. There is an event for
/// each cell for which a condition holds at the end of the step. Its moment is the first moment at
/// which the condition holds, with an error of 2^-20 of the step (2^-16 in single precision). A
/// condition whose value passes smoothly through 0 takes about five evaluations, any other at most
/// 24. If conditions read other cells or the time, only the events of the first moment are found
/// and returned, because they may change later conditions. No condition may hold at the beginning.
/// Fails if `reach` fails.
Result<std::vector<CellEvent>> events_within(const TissueRules::Conditions& conditions,
                                             const StepCubic& cubic, const Tissue& tissue,
                                             ValueRunner& runner, const Reach& reach);

}  // namespace cascade
