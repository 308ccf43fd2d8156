// Ranges of rows, which also select a part of a grid.
#pragma once

#include <cstdint>

namespace cascade {

/// Half-open range of rows.
struct RowRange {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    bool empty() const { return begin >= end; }
    std::int64_t count() const { return end - begin; }
    friend bool operator==(const RowRange&, const RowRange&) = default;
};

/// Part `index` of `count` nearly equal parts of [0, rows).
RowRange split_rows(std::int64_t rows, int index, int count);

}  // namespace cascade
