// The header of a .npy file: what kind of array follows and where.
//
// A file is \x93NUMPY, two bytes of version, the header's size (16 bits little-endian, from version
// 2 on 32 bits) and the header: a Python dictionary of `descr`, `fortran_order` and `shape`. The
// keys may come in any order, with any blanks, as NumPy's own reader takes them.
#pragma once

#include "core/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// A header as it is written, before anyone asks whether we can read such an array.
struct NpyHeader {
    std::string type;  ///< `descr`, such as "<f4"; "" where it is no text (a structured type).
    bool fortran_order = false;
    std::vector<std::uint64_t> shape;
    std::size_t data_begin = 0;  ///< Bytes before the first element.
};

/// Fails on what is no .npy file, on a cut or malformed header, on an unknown version.
Result<NpyHeader> parse_npy_header(std::string_view bytes);

}  // namespace cascade
