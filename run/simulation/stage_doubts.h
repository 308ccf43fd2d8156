// What the result of a stage says about itself: signs that it is wrong although all values are
// finite.
#pragma once

#include "run/simulation/trial_steps.h"

#include <optional>
#include <string>

namespace cascade {

/// The first such sign of a stage that has taken steps, in words.
std::optional<std::string> find_doubt(const EndedStage& ended);

/// Has a stage that has ended the values that it began with, because its rates are 0 everywhere?
bool has_stood_still(const StageView& view);

}  // namespace cascade
