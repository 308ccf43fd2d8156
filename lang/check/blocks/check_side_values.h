// Checks whether the values at sides can be computed each time the rates are computed (internal to
// the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

namespace cascade::checking {

/// Reports a species that has a flux at a side but does not diffuse, a value at a side that needs
/// cells away from the side, and a solver that cannot evaluate a rule at a side. The program must
/// have no other errors.
void check_side_values(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
