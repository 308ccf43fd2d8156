// The folder of a sweep, which stores a result of each run.
#pragma once

#include "run/commands/sweep.h"
#include "run/commands/sweep_plan.h"

namespace cascade {

/// Creates the folder and removes files that killed processes have left in it. Fails if files
/// cannot be written there.
Result<void> prepare_folder(const std::filesystem::path& folder);

/// Returns the result of a run from the folder. If only a gathered folder has the result, copies it
/// to the folder first. Returns an empty optional if the run must be taken. Fails if the copy
/// cannot be written.
Result<std::optional<SweepResult>> earlier_result(const SweepRequest& request,
                                                  const std::filesystem::path& folder,
                                                  const PlannedRun& run);

}  // namespace cascade
