// Whether the values of sides can be computed whenever the rates are (internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

namespace cascade::checking {

/// Reports fluxes that no diffusion carries, values of sides that need other cells, and solvers
/// that cannot follow a side. The program must be free of errors otherwise.
void check_side_values(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
