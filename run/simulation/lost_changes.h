// Changes that single precision rounds away when a stage adds them to its values.
#pragma once

#include "run/simulation/trial_steps.h"

#include <optional>
#include <string>

namespace cascade {

/// Changes of a species that rounding has made ineffective, and that would have become noticeable.
struct ChangesLost {
    std::string species;
    double change = 0;  ///< The mean magnitude of the change in one step, over the cells.
    double value = 0;   ///< The root mean square of the values to which it is added.
    double lost = 0;    ///< The sum of the changes lost during the stage.
};

/// Whether a stage can have lost enough to matter.
bool could_lose_changes(const StageView& view);

/// The first species that has lost changes.
std::optional<ChangesLost> find_lost_changes(const EndedStage& ended);

}  // namespace cascade
