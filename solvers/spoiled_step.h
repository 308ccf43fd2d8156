// The step in which a value stopped being finite.
#pragma once

#include "solvers/advance.h"
#include "solvers/stepper.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The first species, and in it the first cell, that is not finite.
std::optional<NotFinite> find_not_finite(const std::vector<Field>& species, std::int64_t step,
                                         std::int64_t last_finite);

/// Goes back to the kept copy, which is as step `last_finite` left it, and takes the same steps
/// again, one by one, up to the one that spoils a value; stops before it. The steps are the same
/// bits, so it is met before `spoiled`. Where nothing is kept the spoiled values have to do.
/// Returns the number of complete steps.
std::int64_t replay(Stepper& stepper, std::int64_t last_finite, std::int64_t spoiled,
                    StageOutcome& outcome);

}  // namespace cascade
