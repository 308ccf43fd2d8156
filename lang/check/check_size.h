// `size` of a stage (internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

namespace cascade::checking {

/// Reports sizes that no trial run can find, or that the domain cannot show. The program must be
/// free of errors otherwise.
void check_sizes(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
