// A part of the cells of a plane: some columns of some rows.
#pragma once

#include "core/rows.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace cascade {

/// Half-open range of columns.
struct ColumnRange {
    std::int64_t begin = 0;
    std::int64_t end = std::numeric_limits<std::int64_t>::max();  ///< May exceed the width.

    bool contains(std::int64_t column) const { return begin <= column && column < end; }
    /// This range, cut off at the width of a row.
    ColumnRange within(std::int64_t width) const { return {begin, std::min(end, width)}; }
    std::int64_t count() const { return end - begin; }
};

/// Rows, numbered through all slices, and a range of columns in each; by default all columns.
struct Patch {
    RowRange rows;
    ColumnRange columns = {};
};

}  // namespace cascade
