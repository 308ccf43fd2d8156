// Signs that the result of a stage is wrong although all values are finite.
#pragma once

#include "run/simulation/stage_view.h"
#include "run/stage/stage_time.h"

#include <optional>
#include <string>

namespace cascade {

/// A stage that has ended, with everything that trial steps need.
struct EndedStage {
    const StageView& view;
    StageState& state;  ///< The state of the view; trial steps restore it.
    StageTimer& timer;
};

/// The first such sign of a stage that has taken steps, as a warning.
std::optional<std::string> find_doubt(const EndedStage& ended);

}  // namespace cascade
