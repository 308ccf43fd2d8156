// Detects results that are probably wrong although all values are finite.
#pragma once

#include "run/simulation/trial_steps.h"

#include <string>

namespace cascade {

/// Returns a warning about the first reason to doubt the result of a stage that has taken steps.
/// Returns "" if there is no such reason.
std::string find_doubt(const EndedStage& ended);

}  // namespace cascade
