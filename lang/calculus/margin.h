// How far a condition is from changing.
#pragma once

#include "lang/program/program.h"

namespace cascade {

/// A formula that is above 0 where the condition holds, and goes through 0 where it begins to hold:
/// a − b for a > b, the smaller of two for `and`, the larger for `or`. Conditions of other kinds
/// are 1 where they hold and −1 elsewhere. So solvers find the moment at which a condition changes
/// as a root.
Formula margin_of(const Formula& condition);

}  // namespace cascade
