// Fields as bytes of files.
#pragma once

#include "core/plane.h"

#include <string>

namespace cascade {

/// Appends the cells of a field, row by row through all slices, as little-endian float32; every NaN
/// as 0x7fc00000, so that equal runs give equal files.
void append_floats(std::string& bytes, const Field& field);

}  // namespace cascade
