// Finds changes that a stage adds to its values and that have no effect, because single precision
// rounds them away.
#pragma once

#include "run/simulation/trial_steps.h"

#include <optional>
#include <string>

namespace cascade {

/// Changes of a species that had no effect because of rounding, and that would otherwise have
/// become noticeable.
struct ChangesLost {
    std::string species;
    double change = 0;  ///< The mean absolute value of the change in one step, over all cells.
    double value = 0;   ///< The root mean square of the values to which the change is added.
    double lost = 0;    ///< The sum of the changes that were lost during the stage.
};

/// Whether a stage may have lost so many changes that it matters.
bool could_lose_changes(const StageView& view);

/// Finds the first species that has lost changes. Returns an empty optional if there is none.
std::optional<ChangesLost> find_lost_changes(const EndedStage& ended);

}  // namespace cascade
