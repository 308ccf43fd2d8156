// Turns a condition into a number whose sign tells whether the condition holds.
#pragma once

#include "lang/program/program.h"

namespace cascade {

/// A formula that is above 0 where the condition holds and passes through 0 where the condition
/// begins to hold: a − b for a > b, the smaller of two margins for `and`, the larger for `or`. For
/// all other conditions it is 1 where they hold and −1 elsewhere. So solvers can find the moment at
/// which a condition changes as a root of this formula.
Formula margin_of(const Formula& condition);

}  // namespace cascade
