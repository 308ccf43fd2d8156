// VTK's .vti files: fields of a grid of three dimensions, for ParaView and its like. The format:
// "VTK File Formats", XML image data with one appended raw block (The VTK User's Guide, 11th
// edition, Kitware 2010, chapter 19).
#pragma once

#include "core/plane.h"
#include "core/result.h"

#include <filesystem>
#include <span>
#include <string>

namespace cascade {

/// A field with the name it is to have in the file.
struct VolumeArray {
    std::string name;
    const Field* field = nullptr;
};

/// Fields of one layout as a .vti file in memory: an array of cell data each, little-endian
/// float32, x running fastest, then y, then z; every NaN as 0x7fc00000. Cells are cubes of side
/// `spacing`; the grid's corner is the origin. y grows downwards in pictures and upwards in VTK.
/// Where `inside` (nullptr: none) is 0 the array vtkGhostType hides the cell.
std::string encode_vti(std::span<const VolumeArray> arrays, double spacing,
                       const Mask* inside = nullptr);

/// Writes encode_vti, atomically.
Result<void> write_vti(const std::filesystem::path& path, std::span<const VolumeArray> arrays,
                       double spacing, const Mask* inside = nullptr);

}  // namespace cascade
