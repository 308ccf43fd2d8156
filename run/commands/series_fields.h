// The fields that a run writes into the arrays of --series.
#pragma once

#include "core/result.h"
#include "run/commands/run.h"
#include "run/pictures/painter.h"
#include "run/pictures/series.h"

namespace cascade {

/// The expressions of --field, in the stage that is shown; without any, the number that pictures
/// show. `painter` must outlive the result. A wrong expression is an error in `script.diagnostics`.
Result<SeriesFields> series_fields(Script& script, const RunRequest& request, Painter& painter);

}  // namespace cascade
