// The time of a stage in the manifest of a saved run: what it needs to go on with the same bits.
#pragma once

#include "run/stage/stage_state.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <vector>

namespace cascade {

struct SavedTime {
    double t = 0;
    TimeState state;
    std::optional<double> last_look;    ///< Of `until: steady(…)`; its species are arrays apart.
    std::vector<Formation> formations;  ///< What it knows of each species; empty without a look.
};

nlohmann::json to_json(const StageState& state);

/// Of a stage with this solver. Throws what the JSON library throws; empty where a number cannot be
/// meant.
std::optional<SavedTime> saved_time_from(const nlohmann::json& json, Solver solver);

}  // namespace cascade
