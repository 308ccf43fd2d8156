// Stages of cells that crawl in saved runs: an array for each value, in the order of the cells'
// numbers, and the rest in the manifest.
#pragma once

#include "core/result.h"
#include "run/commands/saved_folder.h"
#include "run/simulation/simulation.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

struct TissueRecord;

/// The names of the arrays of a stage.
std::vector<std::string> cell_arrays(const Program& program, std::uint32_t stage);

/// Adds the arrays of a stage that has cells, and returns its part of the manifest.
Result<nlohmann::json> save_cells(SavedFolderChange& change, const Simulation& simulation,
                                  std::uint32_t stage);

/// Reads them back. Fails, in words that follow "is damaged: ", on arrays that do not fit together
/// and on numbers out of range. Throws what the JSON library throws.
Result<TissueRecord> read_cells(const std::filesystem::path& folder, const nlohmann::json& manifest,
                                const nlohmann::json& cells, const Simulation& simulation,
                                std::uint32_t stage);

}  // namespace cascade
