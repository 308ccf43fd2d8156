// The time of a stage in the manifest of a saved run: the state from which it goes on with the same
// bits.
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

/// The last evaluation of `until: steady(…)`; its species are separate arrays.
struct SavedLook {
    double t = 0;
    std::vector<Formation> formations;  ///< By species.
};

// Both throw what the JSON library throws, and return false if a number is out of range.

/// Reads the time of a stage of fields with this solver, and the last evaluation of `steady`, if
/// there was one.
bool read_json(const nlohmann::json& json, Solver solver, StageMoment& progress,
               std::optional<SavedLook>& look);
bool read_json(const nlohmann::json& json, TissueTime& time);

}  // namespace cascade
