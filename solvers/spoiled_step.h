// Finds the step in which a value stopped being finite.
#pragma once

#include "solvers/advance.h"
#include "solvers/stepper.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The first non-finite value, by species, then by cell.
std::optional<NotFinite> find_not_finite(const std::vector<Field>& species, std::int64_t step,
                                         std::int64_t last_finite);

/// Restores the stored copy, the state after step `last_finite`, and repeats the steps one by one
/// until a step spoils a value. The values before that step remain. Repeated steps have the same
/// bits, so a spoiled value is found in step `spoiled` or earlier. Without a stored copy, returns
/// at once and leaves the spoiled values. If a step is abandoned, `outcome` has a range of steps,
/// and the values are the last finite values. Returns the number of complete steps.
std::int64_t replay(Stepper& stepper, std::int64_t last_finite, std::int64_t spoiled,
                    StageOutcome& outcome);

}  // namespace cascade
