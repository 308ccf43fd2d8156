// One stage in a saved run: an array for each of its values, and the rest in the manifest.
#pragma once

#include "core/result.h"
#include "run/commands/saved_folder.h"
#include "run/simulation/simulation.h"
#include "run/simulation/stage_record.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

/// The names of all arrays that a stage may have.
std::vector<std::string> stage_arrays(const Program& program, std::uint32_t stage);

/// Adds the arrays of a stage that has started, and returns its part of the manifest.
Result<nlohmann::json> save_stage(SavedFolderChange& change, const Simulation& simulation,
                                  std::uint32_t stage);

/// Reads a stage back, for a simulation in which it has started. `saved` is its part of the
/// manifest. Fails on arrays that do not fit together and on numbers out of range; the message
/// follows "is damaged: ". Throws what the JSON library throws.
Result<StageRecord> read_stage(const std::filesystem::path& folder, const nlohmann::json& manifest,
                               const nlohmann::json& saved, const Simulation& simulation,
                               std::uint32_t stage);

}  // namespace cascade
