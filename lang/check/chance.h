// Warnings about random numbers: a seed that has no effect, and noise that depends on the step.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

namespace cascade {

/// Warns if --seed is given although neither the stages nor the domain draw random numbers.
void warn_of_idle_seed(const ast::Script& script, const Program& program, Diagnostics& diagnostics);

/// Warns if random numbers are drawn at each step in a stage that chooses the lengths of its steps.
/// Noise is weaker if steps are shorter, unless `white` compensates for this.
void warn_of_draws_by_step(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade
