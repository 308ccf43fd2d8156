// Random numbers of a program: whether there are any, and whether they are as strong as one would
// think.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

namespace cascade {

/// Does anything that the stages compute draw random numbers, or the mask?
bool draws_random_numbers(const Program& program);

/// Warns of draws at each step where steps are of chosen length: the noise is the weaker, the
/// shorter they are. `white` makes up for that.
void warn_of_draws_by_step(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade
