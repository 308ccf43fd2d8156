// The cells beside a side of a plane, numbered along this side, so that the side's values can be
// stored and computed without a plane.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/side.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The numbers of the cells beside a side: rows [begin, end) contain the cells [first, first +
/// count), in order of rows and columns.
struct SideCells {
    std::int64_t first = 0, count = 0;

    static SideCells of_rows(const PlaneLayout& layout, Side side, RowRange rows);
    /// The distance in elements from cell (0, 0, 0) to a cell beside the side.
    static std::int64_t offset(const PlaneLayout& layout, Side side, std::int64_t number);
};

/// The values of all cells beside a side.
std::vector<double> values_beside(const Field& field, Side side);

}  // namespace cascade
