// Warnings about domains that grow (spec/domain.md, Growth).
#pragma once

#include "run/simulation/stage_view.h"

#include <optional>
#include <string>

namespace cascade {

/// A warning if a stage reads values of an earlier stage, but its domain begins with other lengths
/// than the domain of the earlier stage had at the end. Amounts then change by the ratio of the
/// lengths. Empty if lengths differ by less than a hundredth.
std::string describe_jump_of_lengths(const StageView& view);

/// The error of the steps in an amount that dilution should preserve.
struct AmountChanged {
    double part = 0;              ///< The change of the amount, as a fraction of the amount.
    std::optional<double> speed;  ///< A length of steps that preserves the amount, if found.
};

/// The error that the steps of a stage make in the integral of a species over a domain that grows,
/// without reaction and sides. To find it, the steps are repeated for a single number, with a
/// method of the solver's order. Empty if the error is below a hundredth, if the stage chooses its
/// steps, or if there are too many steps to repeat.
std::optional<AmountChanged> find_changed_amount(const StageView& view);

}  // namespace cascade
