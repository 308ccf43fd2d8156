// NumPy's .npy files: one array, little-endian float32 written, float32 and float64 read.
#pragma once

#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace cascade {

/// An array of rows × columns in C order. A one-dimensional file has one row.
struct NpyArray {
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    std::vector<float> values;
};

/// Reads format versions 1 to 3. Fails, with the reason, on other types, Fortran order, more than
/// two dimensions, a truncated or oversized file, a bad header.
Result<NpyArray> read_npy(const std::filesystem::path& path);

/// Writes rows × columns float32 in C order, atomically; every NaN as 0x7fc00000.
Result<void> write_npy(const std::filesystem::path& path, const Field& field);

}  // namespace cascade
