// The header of a .npy file, which describes its array.
//
// A file consists of \x93NUMPY, two bytes of version, the header's size (16 bits little-endian,
// from version 2 on 32 bits) and the header: a Python dictionary of `descr`, `fortran_order` and
// `shape`. As in NumPy's reader, the order of keys and blanks do not matter.
#pragma once

#include "core/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// A header as written, whether or not this program supports such an array.
struct NpyHeader {
    std::string type;  ///< `descr`, such as "<f4"; "" if it is no string (a structured type).
    bool fortran_order = false;
    std::vector<std::uint64_t> shape;
    std::size_t data_begin = 0;  ///< Offset of the first element.
};

/// Fails if the data is no .npy file, truncated or malformed, or has an unknown version.
Result<NpyHeader> parse_npy_header(std::string_view bytes);

}  // namespace cascade
