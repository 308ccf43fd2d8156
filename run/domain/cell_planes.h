// Makes planes with a value for each cell of a model. The cells are in the order in which memory
// stores them.
#pragma once

#include "core/plane.h"
#include "ir/word_format.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace cascade {

/// Calls `write(row, column, cell, is_cell)` for all positions of the rows. order[k] is the cell at
/// position k. In the unused positions at the end of the last row, `cell` is the last cell and
/// `is_cell` is false.
template <typename Write>
void for_each_place(const Grid& grid, const std::vector<std::uint32_t>& order, const Write& write) {
    const std::size_t count = order.size();
    std::size_t k = 0;
    for (std::int64_t row = 0; row < grid.height; ++row) {
        for (std::int64_t i = 0; i < grid.width; ++i, ++k) {
            write(row, i, order[std::min(k, count - 1)], k < count);
        }
    }
}

/// Makes a plane with the values `value(cell, is_cell)`, whose arguments for_each_place() explains.
/// Values are numbers, or unsigned integers for a plane of words.
template <typename Value>
Field plane_of_cells(const Grid& grid, const std::vector<std::uint32_t>& order, Precision precision,
                     const Value& value) {
    Field field{PlaneLayout(grid), precision};
    field.visit([&]<typename Number>(Plane<Number>& cells) {
        for_each_place(
            grid, order, [&](std::int64_t row, std::int64_t i, std::size_t cell, bool is_cell) {
                const auto found = value(cell, is_cell);
                if constexpr (std::is_same_v<std::remove_const_t<decltype(found)>, std::uint32_t>) {
                    const WordOf<Number> word = found;
                    std::memcpy(cells.row(row) + i, &word, sizeof word);
                } else {
                    cells.row(row)[i] = static_cast<Number>(found);
                }
            });
    });
    return field;
}

}  // namespace cascade
