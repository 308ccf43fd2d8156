// The time of a stage in the manifest of a saved run: the state from which it goes on with the same
// bits.
#pragma once

#include "run/stage/stage_state.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <vector>

namespace cascade {

struct SavedTime {
    double t = 0;
    TimeState state;
    std::optional<double> last_look;  ///< Of `until: steady(…)`; its species are separate arrays.
    std::vector<Formation> formations;  ///< By species; empty before the first evaluation.
};

nlohmann::json to_json(const StageState& state);

/// Reads the state of a stage with this solver. Throws what the JSON library throws; returns
/// nothing if a number is out of range.
std::optional<SavedTime> saved_time_from(const nlohmann::json& json, Solver solver);

}  // namespace cascade
