// Checks whether the solver of a stage can compute the stage, for solvers that treat diffusion, or
// the reaction in each cell, implicitly (internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstddef>
#include <cstdint>

namespace cascade::checking {

/// The largest number of species for which a kernel solves equations in each cell. The size of such
/// a kernel and its compile time grow with the third power of the number of species.
inline constexpr std::size_t most_species_in_equations = 12;

/// If the stage's solver is implicit in each cell, reports at `span` everything in the stage that
/// the solver cannot handle. The program must have no other errors.
void check_local_solver(const Program& program, std::uint32_t stage, Span span,
                        Diagnostics& diagnostics);

/// If the stage's solver is semi-implicit, reports at `span` everything in the stage that the
/// solver cannot handle. The program must have no other errors.
void check_semi_implicit(const Program& program, std::uint32_t stage, Span span,
                         Diagnostics& diagnostics);

}  // namespace cascade::checking
