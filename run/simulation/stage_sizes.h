// The sizes that stages ask for, found by trial runs and kept for later ones.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"

namespace cascade {

/// Scales the lengths of the stages that run and have a size, so that `here` gets a program of its
/// own; says what was found. Factors are kept in the process and beside compiled kernels; no result
/// depends on whether one was found there. Sizes that cannot be had are errors in
/// `script.diagnostics`, and the result fails. `here` is complete but for its mask.
Result<void> find_sizes(Environment& here, Script& script, const SimulationOptions& options,
                        RunControl& control);

/// Does a stage that runs have a size?
bool has_sizes(const Script& script);

/// The program of a checked script as it runs, with the sizes of its stages; that of the script if
/// there are none. Fails like Simulation::create().
Result<std::shared_ptr<const Program>> sized_program(Script& script,
                                                     const SimulationOptions& options);

}  // namespace cascade
