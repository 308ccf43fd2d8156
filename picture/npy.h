// NumPy's .npy files: one array. Writes little-endian floats in a field's precision. Reads floats,
// integers and booleans of both byte orders. The format is NumPy Enhancement Proposal 1.
#pragma once

#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// An array of slices × rows × columns in C order. If a file has one dimension, the array has one
/// row and one slice. If it has two, the array has one slice.
struct NpyArray {
    std::int64_t slices = 1;
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    std::vector<double> values;
};

/// An array from a .npy file in memory, format versions 1 to 3. Types f4 f8 i1 i2 i4 i8 u1 u2 u4 u8
/// b1, little- or big-endian. Values are rounded to a precision. Fails on other types, Fortran
/// order, zero or more than three dimensions, no elements, missing or surplus bytes, and malformed
/// headers. The message is a clause that follows "cannot read 'FILE': ".
Result<NpyArray> parse_npy(std::string_view bytes, Precision precision = Precision::single);

/// The largest .npy file, in bytes, that is read.
inline constexpr std::uint64_t largest_npy_file =
    (std::uint64_t{1} << 34) + (std::uint64_t{1} << 17);

/// The same for a file.
Result<NpyArray> read_npy(const std::filesystem::path& path,
                          Precision precision = Precision::single);

/// The header of a .npy file as NumPy writes it, version 1.0. The elements follow it in C order.
/// `type` is NumPy's, such as "<f4". `shape` is the inside of a tuple, such as "2, 3" or "2,".
/// `spare`: characters by which a shape that replaces it later may be longer.
std::string npy_head(std::string_view type, std::string_view shape, std::size_t spare = 0);

/// A field as a .npy file in memory: version 1.0, rows × columns (slices × rows × columns if there
/// are several slices) of little-endian float32 or float64 in C order. Every NaN is 0x7fc00000 or
/// 0x7ff8000000000000.
std::string encode_npy(const Field& field);

/// Writes encode_npy(field) atomically.
Result<void> write_npy(const std::filesystem::path& path, const Field& field);

/// Whether the array has the size of the grid.
bool fits(const NpyArray& array, const Grid& grid);

/// The array, rounded to a precision, as a field of columns × rows × slices with a zero halo.
Field to_field(const NpyArray& array, Precision precision = Precision::single);

}  // namespace cascade
