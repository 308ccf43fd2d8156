// Turns a condition into a number whose sign tells whether the condition holds.
#pragma once

#include "lang/program/program.h"

namespace cascade {

/// A formula that is above 0 where the condition holds and that passes through 0 where the
/// condition begins to hold. It is a − b for a > b, the smaller of the two margins for `and`, and
/// the larger margin for `or`. For any other condition it is 1 where the condition holds and −1
/// elsewhere. Solvers use this formula to find the moment at which a condition changes as a root.
Formula margin_of(const Formula& condition);

}  // namespace cascade
