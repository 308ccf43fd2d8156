// Finds infinities and NaNs in fields, fast enough to check often.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// The place of a cell: its column, row and slice.
struct CellPlace {
    std::int64_t column = 0, row = 0, slice = 0;
    friend bool operator==(const CellPlace&, const CellPlace&) = default;
};

/// Whether all values in `cells` are finite. Ignores halo and padding, which may contain anything.
bool are_finite(const Field& field, const Patch& cells);

/// The first non-finite cell, row by row.
std::optional<CellPlace> first_not_finite(const Field& field);

}  // namespace cascade
