// What formulas of the time and of places do during a stage, before its steps are taken.
#pragma once

#include "run/simulation/stage_view.h"
#include "run/stage/forcing.h"

#include <vector>

namespace cascade {

/// The values of a formula of constants and `t` alone. The view must outlive it.
ValueAt values_at(const StageView& view, const Formula& formula);

/// For a formula of constants, places and `t`: the part of it that changes within a 1000th of the
/// duration, at up to 1000 moments that are spread evenly; fewer if there are many cells. The part
/// is the sum of all changes, divided by the sum of all differences from the mean at the moment
/// when that sum is largest.
std::vector<double> motion_over(const StageView& view, const Formula& formula, double duration);

}  // namespace cascade
