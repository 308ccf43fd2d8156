// Warnings about random numbers: a seed that has no effect, and noise that depends on the step.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

namespace cascade {

/// Warns of --seed if neither a stage nor the domain draws random numbers.
void warn_of_idle_seed(const ast::Script& script, const Program& program, Diagnostics& diagnostics);

/// Warns of draws at each step in stages that choose their steps: the shorter the steps, the weaker
/// the noise. `white` compensates for that.
void warn_of_draws_by_step(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade
