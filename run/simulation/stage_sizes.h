// Finds, by trial runs, the factors that give stages their wanted sizes, and stores the factors for
// later runs.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"

namespace cascade {

/// Scales the lengths of all stages that run and have a size, reports the factors found, and gives
/// `here` the scaled program. Factors are stored in the process and beside compiled kernels, and no
/// result depends on whether a stored factor is used. A size that cannot be reached is an error in
/// `script.diagnostics`, and the result is then a failure. `here` must be complete except for its
/// mask.
Result<void> find_sizes(Environment& here, Script& script, const SimulationOptions& options,
                        RunControl& control);

/// Gives the crawling cells on a model the radii that follow from the sizes of their stages, and
/// reports the radii. Throws std::bad_alloc.
void size_cells(Environment& here, const ModelCells& cells, RunControl& control);

/// Whether a stage of fields that runs has a size.
bool has_sizes(const Script& script);

/// The program that runs, with lengths scaled for the sizes of its stages. Without sizes it is the
/// script's own program. Fails like Simulation::create().
Result<std::shared_ptr<const Program>> sized_program(Script& script,
                                                     const SimulationOptions& options);

}  // namespace cascade
