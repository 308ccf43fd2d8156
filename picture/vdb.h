// Writes .vdb files of the library OpenVDB. They contain volumes for Blender, Houdini and renderers
// (K. Museth, "VDB: High-Resolution Sparse Volumes with Dynamic Topology", ACM Transactions on
// Graphics 32(3), 2013). Cascade calls OpenVDB in a plug-in, a separate shared library. The
// plug-in is built if OpenVDB is installed, and is loaded when the first file is checked or
// written.
#pragma once

#include "core/result.h"
#include "picture/volume_array.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// The content of a .vdb file: a grid for each array, and metadata.
struct VdbVolume {
    /// At least one array. All arrays must have the same layout.
    std::span<const VolumeArray> arrays;
    std::array<double, 3> spacing{1, 1, 1};  ///< The lengths of a cell along x, y and z.
    /// Voxels are inactive where this mask is 0. Null if all voxels are active.
    const Mask* inside = nullptr;
    std::map<std::string, std::string> texts;
    std::string stage;
    std::int64_t step = 0;
    double time = 0;  ///< The time since the start of the stage. NaN is not written.
};

/// The name of the plug-in's only symbol. The symbol is a function that takes the version of its
/// caller and returns the encoder, or null if the plug-in has another version.
inline constexpr const char* vdb_encoder_symbol = "cascade_vdb_encoder";
using VdbEncoder = Result<std::string>(const VdbVolume& volume);
using VdbEncoderEntry = VdbEncoder*(std::string_view version);

/// Loads the plug-in that writes .vdb files. Fails if this build has no plug-in or if the OpenVDB
/// library is missing. The error message is about the output file `path`, and says what to install.
Result<void> check_vdb(const std::filesystem::path& path);

/// Writes a file atomically. Each array becomes a fog volume with the name and the precision of the
/// array. The centre of cell (i, j, k) is at (i + ½, j + ½, k + ½) · spacing, as in a .vti file.
/// The voxels of all cells inside the domain are active. Every NaN is written as 0x7fc00000 or
/// 0x7ff8000000000000. Equal volumes give equal bytes. Fails if check_vdb() or write_file() would
/// fail, and if memory is exhausted.
Result<void> write_vdb(const std::filesystem::path& path, const VdbVolume& volume);

}  // namespace cascade
