// Stores one stage of a saved run: each plane of values in an array, and everything else in the
// manifest.
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

/// Returns the names of all arrays that a stage may have.
std::vector<std::string> stage_arrays(const Program& program, std::uint32_t stage);

/// Writes the arrays of a started stage, and returns its part of the manifest.
Result<nlohmann::json> save_stage(SavedFolderChange& change, const Simulation& simulation,
                                  std::uint32_t stage);

/// Reads the stage whose part of the manifest is `saved`, for a simulation in which it has started.
/// Fails if arrays do not fit together or numbers are out of range, with a message that follows the
/// words "is damaged: ". Throws the exceptions of the JSON library.
Result<StageRecord> read_stage(const std::filesystem::path& folder, const nlohmann::json& manifest,
                               const nlohmann::json& saved, const Simulation& simulation,
                               std::uint32_t stage);

}  // namespace cascade
