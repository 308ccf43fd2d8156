// Fields as bytes of files.
#pragma once

#include "core/plane.h"

#include <string>

namespace cascade {

/// Appends the cells of a field, row by row through all slices, as little-endian float32 or
/// float64, as its precision is; every NaN as one, so that equal runs give equal files.
void append_floats(std::string& bytes, const Field& field);

}  // namespace cascade
