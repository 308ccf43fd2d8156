// Detects results that are probably wrong although all values are finite.
#pragma once

#include "run/simulation/trial_steps.h"

#include <string>

namespace cascade {

/// A warning about the first reason to doubt the result of a stage that has taken steps. "" if
/// there is none.
std::string find_doubt(const EndedStage& ended);

}  // namespace cascade
