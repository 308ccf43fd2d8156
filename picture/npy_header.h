// Reads the header of a .npy file, which describes its array.
//
// A file consists of \x93NUMPY, two bytes of version, the size of the header (16 bits, or 32 bits
// from version 2 on, little-endian), the header, and the elements. The header is a Python
// dictionary with `descr`, `fortran_order` and `shape`. As in NumPy's own reader, the order of the
// keys and blanks between them do not matter.
#pragma once

#include "core/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The content of a header. The header may describe an array that this program does not support.
struct NpyHeader {
    /// The text of `descr`, such as "<f4". Empty for a structured type, whose `descr` is not a
    /// string.
    std::string type;
    bool fortran_order = false;
    std::vector<std::uint64_t> shape;
    std::size_t data_begin = 0;  ///< The offset of the first element in the file.
};

/// Fails if the data is not a .npy file, is incomplete or invalid, or has an unknown version.
Result<NpyHeader> parse_npy_header(std::string_view bytes);

}  // namespace cascade
