// Writes VTK's .vti files, which contain fields on three-dimensional grids, for ParaView and
// similar programs. The format is "VTK File Formats", XML image data with one appended raw block
// (The VTK User's Guide, 11th edition, Kitware 2010, chapter 19).
#pragma once

#include "core/result.h"
#include "picture/volume_array.h"

#include <array>
#include <filesystem>
#include <span>
#include <string>

namespace cascade {

/// Encodes fields of the same layout as a .vti file in memory. Each field becomes an array of cell
/// data in little-endian float32, ordered so that x varies fastest, then y, then z. Every NaN is
/// written as 0x7fc00000. Cells are boxes with the sides `spacing`, and the corner of the grid is
/// the origin. y points down in pictures, but up in VTK. The array vtkGhostType hides the cells in
/// which `inside` is 0. If `inside` is null, no cell is hidden.
std::string encode_vti(std::span<const VolumeArray> arrays, const std::array<double, 3>& spacing,
                       const Mask* inside = nullptr);

/// Writes the result of encode_vti() atomically.
Result<void> write_vti(const std::filesystem::path& path, std::span<const VolumeArray> arrays,
                       const std::array<double, 3>& spacing, const Mask* inside = nullptr);

}  // namespace cascade
