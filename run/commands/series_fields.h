// The fields that a run writes to the arrays of option --series.
#pragma once

#include "core/result.h"
#include "run/commands/run.h"
#include "run/pictures/painter.h"
#include "run/pictures/series.h"

namespace cascade {

/// Returns the fields that the expressions of --field give in the shown stage. Without --field,
/// returns the number that pictures show or, for a .h5 file, the species of all stages. `painter`
/// must outlive the result. An invalid expression is an error in `script.diagnostics`.
Result<SeriesFields> series_fields(Script& script, const RunRequest& request, Painter& painter);

}  // namespace cascade
