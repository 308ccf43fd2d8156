// Finds, by trial runs, the factors that give stages their wanted sizes, and stores the factors for
// later runs.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"

namespace cascade {

/// Scales the lengths of all stages that run and have a size, reports the factors found, and gives
/// `here` the scaled program. Factors are stored in memory and in the folder of compiled kernels.
/// No result depends on whether a stored factor is used. If a size cannot be reached, adds an error
/// to `script.diagnostics` and fails. `here` must be complete except for its mask.
Result<void> find_sizes(Environment& here, Script& script, const SimulationOptions& options,
                        RunControl& control);

/// Gives the crawling cells on a model the radii that follow from the sizes that their stages
/// request, and reports the radii. Throws std::bad_alloc.
void size_cells(Environment& here, const ModelCells& cells, RunControl& control);

/// Whether a stage of fields that runs has a size.
bool has_sizes(const Script& script);

/// Returns the program that runs, with lengths scaled for the sizes of its stages. If no stage has
/// a size, it is the script's own program. Fails in the same cases as Simulation::create().
Result<std::shared_ptr<const Program>> sized_program(Script& script,
                                                     const SimulationOptions& options);

}  // namespace cascade
