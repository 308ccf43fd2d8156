// From the lengths of a domain, as formulas of time, to its growth.
#pragma once

#include "core/grid.h"
#include "lang/program/growth.h"

#include <optional>
#include <span>

namespace cascade {

/// The growth of a domain whose sides have these lengths along x, y and z, formulas of numbers and
/// `t`. Sides that are left out grow like the first. The dilution is the sum of the logarithmic
/// derivatives of the lengths. Empty if there is no rule for the derivative of a length. `written`
/// and `span` are left to the caller.
std::optional<Growth> growth_of(std::span<const Formula> lengths, const Grid& grid);

}  // namespace cascade
