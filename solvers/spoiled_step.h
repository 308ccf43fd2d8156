// The step in which a value stopped being finite.
#pragma once

#include "solvers/advance.h"
#include "solvers/stepper.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The first value that is not finite: its species, then its cell.
std::optional<NotFinite> find_not_finite(const std::vector<Field>& species, std::int64_t step,
                                         std::int64_t last_finite);

/// Goes back to the kept copy, which is as step `last_finite` left it, and repeats the steps one by
/// one until one spoils a value; stops before it. The repeated steps have the same bits, so it is
/// found before `spoiled`. Without a kept copy it returns at once, with the spoiled values in
/// place. If a step is abandoned, `outcome` has a range of steps, and the values are
/// the finite ones that were reached. Returns the number of complete steps.
std::int64_t replay(Stepper& stepper, std::int64_t last_finite, std::int64_t spoiled,
                    StageOutcome& outcome);

}  // namespace cascade
