// One run of a sweep.
#pragma once

#include "run/commands/sweep.h"
#include "run/commands/sweep_plan.h"

#include <filesystem>
#include <optional>

namespace cascade {

/// Takes a run, measures it and, if requested, saves its fields below `folder`. If values are not
/// finite, the result has the reason as its remark. Empty if the run was cancelled. Fails for
/// reasons that would stop every run.
tl::expected<std::optional<SweepResult>, SweepError> take_run(
    const Script& base, const PlannedRun& run, const SweepRequest& request,
    const SimulationOptions& options, const std::filesystem::path& folder, RunControl& control);

}  // namespace cascade
