// Warnings about domains that grow (spec/domain.md, Growth).
#pragma once

#include "run/simulation/stage_view.h"

#include <optional>
#include <string>

namespace cascade {

/// Returns a warning if a stage reads values of an earlier stage, and its domain begins with other
/// lengths than the domain of the earlier stage had at its end. Amounts then change by the ratio of
/// the lengths. Returns an empty string if lengths differ by less than a hundredth.
std::string describe_jump_of_lengths(const StageView& view);

/// The error that steps make in an amount that dilution should preserve.
struct AmountChanged {
    double part = 0;  ///< The change of the amount, as a fraction of the amount.
    /// A length of steps with which the amount is preserved. Empty if none was found.
    std::optional<double> speed;
};

/// Finds the error that the steps of a stage make in the integral of a species over a domain that
/// grows, without reaction and sides. To find the error, the steps are taken again for a single
/// number, with a method of the solver's order. Returns an empty optional if the error is below a
/// hundredth, if the stage chooses its steps, or if there are too many steps to take again.
std::optional<AmountChanged> find_changed_amount(const StageView& view);

}  // namespace cascade
