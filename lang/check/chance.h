// Warnings about random numbers: a seed that nothing reads, and noise that depends on the step.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

namespace cascade {

/// Warns of --seed where neither a stage nor the mask draws random numbers.
void warn_of_idle_seed(const ast::Script& script, const Program& program, Diagnostics& diagnostics);

/// Warns of draws at each step in stages that choose their steps: the shorter the steps, the weaker
/// the noise. `white` makes up for that.
void warn_of_draws_by_step(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade
