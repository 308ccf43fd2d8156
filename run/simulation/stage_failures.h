// Why the steps of a stage failed.
#pragma once

#include "core/result.h"
#include "run/simulation/stage_view.h"
#include "solvers/advance.h"

namespace cascade {

/// Of an outcome with a value that is not finite, or with steps that have become too short. `state`
/// is that of the view; where its values are spoiled it is put where the stage began.
Failure explain(const StageOutcome& outcome, const StageView& view, StageState& state);

}  // namespace cascade
