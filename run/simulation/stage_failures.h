// Why the steps of a stage failed.
#pragma once

#include "core/result.h"
#include "run/simulation/stage_view.h"
#include "solvers/advance.h"

#include <atomic>

namespace cascade {

/// For an outcome with a value that is not finite, or with steps that have become too short.
/// `state` is the view's; if its values are spoiled, it is reset to the start of the stage.
Failure explain(const StageOutcome& outcome, const StageView& view, StageState& state,
                const std::atomic<bool>& cancel);

}  // namespace cascade
