// What semi-implicit solvers cannot take (internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>

namespace cascade::checking {

/// Faults of a stage whose solver is semi-implicit, at `span`; none of other stages. The program is
/// sound otherwise.
void check_semi_implicit(const Program& program, std::uint32_t stage, Span span,
                         Diagnostics& diagnostics);

}  // namespace cascade::checking
