// VTK's .vti files: fields on three-dimensional grids, for ParaView and similar programs. The
// format is "VTK File Formats", XML image data with one appended raw block (The VTK User's Guide,
// 11th edition, Kitware 2010, chapter 19).
#pragma once

#include "core/result.h"
#include "picture/volume_array.h"

#include <filesystem>
#include <span>
#include <string>

namespace cascade {

/// Fields of one layout as a .vti file in memory: an array of cell data each, little-endian
/// float32, in the order x, y, z. Every NaN is 0x7fc00000. Cells are cubes of side `spacing`, and
/// the grid's corner is the origin. y points down in pictures and up in VTK. The array vtkGhostType
/// hides cells where `inside` is 0. nullptr hides none.
std::string encode_vti(std::span<const VolumeArray> arrays, double spacing,
                       const Mask* inside = nullptr);

/// Writes encode_vti() atomically.
Result<void> write_vti(const std::filesystem::path& path, std::span<const VolumeArray> arrays,
                       double spacing, const Mask* inside = nullptr);

}  // namespace cascade
