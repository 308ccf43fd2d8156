// Warnings about domains that grow (spec/domain.md, Growth).
#pragma once

#include "run/simulation/stage_view.h"

#include <optional>
#include <string>

namespace cascade {

/// A warning if the domain of a stage begins with other lengths than the earlier stage had at its
/// end whose values the stage reads, because amounts then change by the ratio of the lengths. Empty
/// if lengths differ by less than a hundredth.
std::string describe_jump_of_lengths(const StageView& view);

/// An error of the steps in what dilution keeps.
struct AmountChanged {
    double part = 0;              ///< The change of an amount, as a part of it.
    std::optional<double> speed;  ///< A length of steps that keeps it, if one was found.
};

/// The error that the steps of a stage make in the integral of a species over a domain that grows,
/// without reaction and sides. The steps are repeated for one number with the order of the solver.
/// Empty if the error is below a hundredth, if the stage chooses its steps, or if there are too
/// many steps to repeat.
std::optional<AmountChanged> find_changed_amount(const StageView& view);

}  // namespace cascade
