// NumPy's .npy files: one array. Little-endian floats of a field's precision are written; floats,
// integers and booleans of both byte orders are read. The format: NumPy Enhancement Proposal 1.
#pragma once

#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// An array of slices × rows × columns in C order. A file of one dimension has one row, one of two
/// has one slice.
struct NpyArray {
    std::int64_t slices = 1;
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    std::vector<double> values;
};

/// An array from a .npy file in memory, format versions 1 to 3. Types f4 f8 i1 i2 i4 i8 u1 u2 u4 u8
/// b1, little- or big-endian, each value rounded to the nearest number of a precision. Fails, with
/// the reason, on other types, Fortran order, no or more than three dimensions, no elements,
/// missing or surplus bytes, a bad header. The message is a clause that follows "cannot read
/// 'FILE': ".
Result<NpyArray> parse_npy(std::string_view bytes, Precision precision = Precision::single);

/// The largest .npy file that is read, in bytes.
inline constexpr std::uint64_t largest_npy_file =
    (std::uint64_t{1} << 34) + (std::uint64_t{1} << 17);

/// The same of a file.
Result<NpyArray> read_npy(const std::filesystem::path& path,
                          Precision precision = Precision::single);

/// The head of a .npy file as NumPy writes it, version 1.0, which the elements follow in C order.
/// `type` as NumPy calls it, such as "<f4"; `shape` as Python writes a tuple, such as "2, 3" or
/// "2,".
std::string npy_head(std::string_view type, std::string_view shape);

/// A field as a .npy file in memory: version 1.0, header as NumPy writes it, rows × columns
/// (slices × rows × columns where there are several slices) of little-endian float32 or float64 in
/// C order; every NaN as 0x7fc00000, or 0x7ff8000000000000.
std::string encode_npy(const Field& field);

/// Writes encode_npy(field), atomically.
Result<void> write_npy(const std::filesystem::path& path, const Field& field);

/// Has the array the sides of the grid?
bool fits(const NpyArray& array, const Grid& grid);

/// The array, rounded to a precision, as a field of a grid of its columns × rows × slices; the halo
/// is zero.
Field to_field(const NpyArray& array, Precision precision = Precision::single);

}  // namespace cascade
