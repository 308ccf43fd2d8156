// What a model's file holds, in words: `cascade mesh`.
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

/// What the model names itself must lie below its folder or those of `access`.
/// Lines about the surface: its parts, what kind of surface it is, its size, what had to be
/// repaired; and about the cells, if some are asked for. Fails on a file that cannot be used
/// (mesh/model_file.h, mesh/make_mesh.h), on cells that cannot be (surface/make_cells.h) and
/// on more than fit into the free memory. Throws std::bad_alloc. Nothing if `cancel` became true.
Result<std::vector<std::string>> describe_model(const std::filesystem::path& path,
                                                const ReadAccess& access,
                                                const std::optional<CellOptions>& cells, Team& team,
                                                const std::atomic<bool>& cancel);

}  // namespace cascade
