// OpenVDB's .vdb files: volumes for Blender, Houdini and renderers (K. Museth, "VDB:
// High-Resolution Sparse Volumes with Dynamic Topology", ACM Transactions on Graphics 32(3), 2013).
// OpenVDB's library is in a module of its own, which is built if OpenVDB is installed and loaded
// for the first file.
#pragma once

#include "core/result.h"
#include "picture/volume_array.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// The content of a .vdb file: a grid for each array, and metadata.
struct VdbVolume {
    std::span<const VolumeArray> arrays;  ///< At least one; all have one layout.
    double spacing = 1;                   ///< The side of a cell.
    const Mask* inside = nullptr;         ///< Voxels are inactive where it is 0. May be null.
    std::map<std::string, std::string> texts;
    std::string stage;
    std::int64_t step = 0;
    double time = 0;  ///< Since the start of the stage. Not written if NaN.
};

/// The name of the module's only symbol: a function that takes the caller's version and returns the
/// encoder, or null if the module's own version differs.
inline constexpr const char* vdb_encoder_symbol = "cascade_vdb_encoder";
using VdbEncoder = Result<std::string>(const VdbVolume& volume);
using VdbEncoderEntry = VdbEncoder*(std::string_view version);

/// Loads the module. Fails, and says what to install, if this build has none or OpenVDB's library
/// is missing.
Result<void> check_vdb(const std::filesystem::path& path);

/// Writes a file atomically: a fog volume of each array by its name, in the array's precision. The
/// centre of cell (i, j, k) lies at (i + ½, j + ½, k + ½) · spacing, as in a .vti file. All voxels
/// of cells inside are active. Each NaN is 0x7fc00000 or 0x7ff8000000000000. Equal volumes give
/// equal bytes. Fails as check_vdb() and write_file() do, and if memory runs out.
Result<void> write_vdb(const std::filesystem::path& path, const VdbVolume& volume);

}  // namespace cascade
