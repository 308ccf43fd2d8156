// Reads and writes NumPy's .npy files, each with a single array. Writes little-endian floats in a
// field's precision. Reads floats, integers and booleans in both byte orders. The format is defined
// in NumPy Enhancement Proposal 1.
#pragma once

#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// An array of slices × rows × columns in C order. A file with one dimension gives one row and one
/// slice. A file with two dimensions gives one slice.
struct NpyArray {
    std::int64_t slices = 1;
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    std::vector<double> values;
};

/// Reads an array from a .npy file in memory, of the format versions 1 to 3. Types are f4, f8, i1,
/// i2, i4, i8, u1, u2, u4, u8 and b1, little- or big-endian. Values are rounded to `precision`.
/// Fails for other types, Fortran order, zero or more than three dimensions, no elements, missing
/// or surplus bytes, and invalid headers. The message is a clause that continues "cannot read
/// 'FILE': ".
Result<NpyArray> parse_npy(std::string_view bytes, Precision precision = Precision::single);

/// The largest .npy file that is read, in bytes.
inline constexpr std::uint64_t largest_npy_file =
    (std::uint64_t{1} << 34) + (std::uint64_t{1} << 17);

/// Reads an array from a file. See parse_npy().
Result<NpyArray> read_npy(const std::filesystem::path& path,
                          Precision precision = Precision::single);

/// The header of a .npy file of version 1.0, as NumPy writes it. The elements must follow in C
/// order. `type` is a type in NumPy's notation, such as "<f4". `shape` is the inside of a Python
/// tuple, such as "2, 3" or "2,". The header has `spare` more characters than needed, so that a
/// longer shape may be written over it later.
std::string npy_head(std::string_view type, std::string_view shape, std::size_t spare = 0);

/// Encodes a field as a .npy file in memory, version 1.0, with float32 or float64 in little-endian
/// C order. The array is rows × columns, or slices × rows × columns if there are several slices.
/// Every NaN is written as 0x7fc00000 or 0x7ff8000000000000.
std::string encode_npy(const Field& field);

/// Writes the result of encode_npy() atomically.
Result<void> write_npy(const std::filesystem::path& path, const Field& field);

/// Whether the array has as many columns, rows and slices as the grid.
bool fits(const NpyArray& array, const Grid& grid);

/// Converts the array to a field of columns × rows × slices, rounded to `precision`. The halo is 0.
Field to_field(const NpyArray& array, Precision precision = Precision::single);

}  // namespace cascade
