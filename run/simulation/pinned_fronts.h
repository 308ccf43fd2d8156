// Fronts that are thinner than a cell and that the grid holds in place.
#pragma once

#include "run/simulation/stage_view.h"

#include <optional>
#include <string>

namespace cascade {

/// A remark on a stage that has ended, if almost all fronts of a species jump from one level to
/// another within a cell, and do not move.
std::optional<std::string> find_pinned_fronts(const StageView& view);

}  // namespace cascade
