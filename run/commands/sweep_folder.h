// The folder of a sweep, which stores a result of each run.
#pragma once

#include "run/commands/sweep.h"
#include "run/commands/sweep_plan.h"

namespace cascade {

/// Creates the folder and removes files that killed processes have left in it. Fails if files
/// cannot be written there.
Result<void> prepare_folder(const std::filesystem::path& folder);

/// The result of a run that the folder stores, or a gathered folder from which it is then copied.
/// Empty if the run must be taken. Fails if the copy cannot be written.
Result<std::optional<SweepResult>> earlier_result(const SweepRequest& request,
                                                  const std::filesystem::path& folder,
                                                  const PlannedRun& run);

}  // namespace cascade
