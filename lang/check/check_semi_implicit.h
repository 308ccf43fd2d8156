// Requirements of semi-implicit solvers (internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>

namespace cascade::checking {

/// Reports at `span` what a semi-implicit solver of the stage cannot handle; nothing for other
/// solvers. The program must be free of errors otherwise.
void check_semi_implicit(const Program& program, std::uint32_t stage, Span span,
                         Diagnostics& diagnostics);

}  // namespace cascade::checking
