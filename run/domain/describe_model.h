// Describes a model's file, for the command `cascade mesh`.
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

/// Reads and repairs a model's file. Other files that it names must be in or below its own folder
/// or the folders of `access`. Fails if the file cannot be used (mesh/model_file.h,
/// mesh/make_mesh.h). Throws std::bad_alloc.
Result<MadeMesh> read_and_repair(const std::filesystem::path& path, const ReadAccess& access);

/// Describes a surface in lines of text: components, topology, size, texture coordinates and
/// repairs. Throws std::bad_alloc.
std::vector<std::string> describe_model(const MadeMesh& made);

/// Describes the texture coordinates of a mesh in one line. The mesh must have texture coordinates.
/// Throws std::bad_alloc.
std::string describe_texture(const SurfaceMesh& mesh);

/// Describes the named positions on a surface (spec/models.md): its extremes along the axes and its
/// tips (surface/tips.h). There is a line for each position, with coordinates as in scripts. Throws
/// std::bad_alloc. The result is meaningless if `cancel` became true.
std::vector<std::string> describe_points(const SurfaceMesh& mesh, const std::atomic<bool>& cancel);

/// Describes the cells that a model would get, in lines of text. Fails if they cannot be made
/// (surface/make_cells.h) or do not fit into the free memory. Throws std::bad_alloc. The result is
/// meaningless if `cancel` became true.
Result<std::vector<std::string>> describe_cells(const SurfaceMesh& mesh, const CellOptions& options,
                                                Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
