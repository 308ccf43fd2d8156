// Requirements of solvers that are implicit in diffusion or in each cell (internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstddef>
#include <cstdint>

namespace cascade::checking {

/// Equations of more species than this would make kernels that take long to compile: their size is
/// proportional to the third power of the number.
inline constexpr std::size_t most_species_in_equations = 12;

/// Reports at `span` what such a solver of the stage cannot handle; nothing for other solvers. The
/// program must be free of errors otherwise.
void check_local_solver(const Program& program, std::uint32_t stage, Span span,
                        Diagnostics& diagnostics);

/// Reports at `span` what a semi-implicit solver of the stage cannot handle; nothing for other
/// solvers. The program must be free of errors otherwise.
void check_semi_implicit(const Program& program, std::uint32_t stage, Span span,
                         Diagnostics& diagnostics);

}  // namespace cascade::checking
