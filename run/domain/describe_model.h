// Describes a model's file, for `cascade mesh`.
#pragma once

#include "core/granted_files.h"
#include "core/parallel.h"
#include "core/result.h"
#include "surface/make_cells.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Files that the model names must lie below its folder or those of `access`.
/// Returns lines about the surface: its components, its topology, its size, the repairs; and about
/// the cells if some are asked for. Fails on a file that cannot be used (mesh/model_file.h,
/// mesh/make_mesh.h), on cells that cannot be made (surface/make_cells.h) and on more cells than
/// fit into the free memory. Throws std::bad_alloc. Returns nothing if `cancel` became true.
Result<std::vector<std::string>> describe_model(const std::filesystem::path& path,
                                                const ReadAccess& access,
                                                const std::optional<CellOptions>& cells, Team& team,
                                                const std::atomic<bool>& cancel);

}  // namespace cascade
