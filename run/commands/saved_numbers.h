// Stores the time of a stage in the file run.json of a saved run, so that a resumed run gets the
// same values, bit for bit.
#pragma once

#include "ir/solver.h"
#include "run/stage/stage_state.h"
#include "tissue/tissue.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <vector>

namespace cascade {

nlohmann::json to_json(const StageMoment& progress);
nlohmann::json to_json(const TissueTime& time);

/// The last evaluation of `until: steady(…)`. The species at that moment are in separate arrays.
struct SavedLook {
    double t = 0;
    std::vector<Formation> formations;  ///< One for each species.
};

// The following functions throw the exceptions of the JSON library, and return false if a number is
// out of range.

/// Reads the time of a stage of fields with this solver. `look` receives the last evaluation of
/// `steady`, and is empty if there was no evaluation.
bool read_json(const nlohmann::json& json, Solver solver, StageMoment& progress,
               std::optional<SavedLook>& look);
bool read_json(const nlohmann::json& json, TissueTime& time);

}  // namespace cascade
