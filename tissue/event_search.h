// Finds when the first cells of a step divide or die.
#pragma once

#include "core/result.h"
#include "tissue/division.h"
#include "tissue/value_runner.h"

#include <functional>
#include <optional>
#include <vector>

namespace cascade {

/// The cells for which conditions hold at a state. One that dies does not divide.
CellEvents events_at(const TissueRules::Conditions& conditions, std::vector<Field>& state,
                     const Tissue& tissue, const StepMoment& moment, ValueRunner& runner);

/// The two ends of a step, with finite values.
struct StepEnds {
    std::vector<Field>& old_state;
    std::vector<Field>& new_state;
    StepMoment moment;  ///< Of the old one; `length` is that of the step.
    /// Called with every state at which values will be evaluated, to make lists that reach there.
    std::function<Result<void>(const std::vector<Field>& state)> reach;
};

struct FirstEvents {
    double part = 1;  ///< Of the step, at the end of which it is 1.
    CellEvents events;
};

/// The first moment of the step at which a condition holds, to 2^-20 of its length (2^-16 in single
/// precision), and the cells for which one holds then or in the following `window`, a part of the
/// step. Conditions whose values go smoothly through 0 take about five evaluations, others up
/// to 24. Values between the ends are those of the cubic through both with the rates there
/// (Hermite), which differs from the solution by a term in step⁴. Nothing if no condition holds at
/// the end. Conditions must not hold at the beginning. Fails if `reach` does.
Result<std::optional<FirstEvents>> first_events(TissueRules& rules, const StepEnds& ends,
                                                double window, const Tissue& tissue,
                                                ValueRunner& runner);

}  // namespace cascade
