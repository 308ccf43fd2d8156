// The cells of a plane, for baking. Rows begin at the top, as in pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade {

struct FlatCells {
    std::int64_t columns = 0, rows = 0;
    double side = 1;  ///< The side length of a cell, in the unit of heights.
    /// Whether the plane repeats along x and y. If not, the values at its edges continue beyond it.
    std::array<bool, 2> repeats{true, true};
    /// 0 in cells outside the domain. Empty if all are inside.
    std::vector<std::uint8_t> inside = {};

    std::size_t count() const { return static_cast<std::size_t>(columns * rows); }
    bool is_inside(std::size_t cell) const { return inside.empty() || inside[cell] != 0; }
    /// The column (or row) from which column (or row) `k` takes its value. `k` may be outside 0 …
    /// count − 1.
    static std::int64_t place(std::int64_t k, std::int64_t count, bool repeats) {
        if (repeats) return (k % count + count) % count;
        return k < 0 ? 0 : k < count ? k : count - 1;
    }
    std::int64_t column(std::int64_t i) const { return place(i, columns, repeats[0]); }
    std::int64_t row(std::int64_t j) const { return place(j, rows, repeats[1]); }
};

}  // namespace cascade
