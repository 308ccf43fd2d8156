// Describes a model's file for `cascade mesh`.
#pragma once

#include "core/granted_files.h"
#include "core/parallel.h"
#include "core/result.h"
#include "mesh/make_mesh.h"
#include "surface/make_cells.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

/// Reads and repairs a model's file. Files that it names must lie below its folder or those of
/// `access`. Fails on a file that cannot be used (mesh/model_file.h, mesh/make_mesh.h). Throws
/// std::bad_alloc.
Result<MadeMesh> read_and_repair(const std::filesystem::path& path, const ReadAccess& access);

/// Lines about the surface: its components, topology, size, texture coordinates and repairs. Throws
/// std::bad_alloc.
std::vector<std::string> describe_model(const MadeMesh& made);

/// A line about the texture coordinates of a mesh that has some. Throws std::bad_alloc.
std::string describe_texture(const SurfaceMesh& mesh);

/// Lines with positions on the surface that have names: its extremes along the axes and its tips
/// (surface/tips.h), in the coordinates of scripts (spec/models.md). Throws std::bad_alloc.
/// Meaningless if `cancel` became true.
std::vector<std::string> describe_points(const SurfaceMesh& mesh, const std::atomic<bool>& cancel);

/// Lines about cells of a model. Fails if they cannot be made (surface/make_cells.h) and on more
/// cells than fit into the free memory. Throws std::bad_alloc. Meaningless if `cancel` became true.
Result<std::vector<std::string>> describe_cells(const SurfaceMesh& mesh, const CellOptions& options,
                                                Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
