// Loops over the cells of planes.
#pragma once

#include "core/plane.h"

#include <cstdint>

namespace cascade {

/// Calls `use` for each cell in order, with that cell's value in each plane. All planes must have
/// the same layout.
template <typename Use, typename First, typename... Others>
void for_each_cell(const Use& use, First& first, Others&... others) {
    const PlaneLayout& layout = first.layout();
    const auto use_row = [&](auto* const... rows) {
        for (std::int64_t i = 0; i < layout.width; ++i) use(rows[i]...);
    };
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        use_row(first.row(row), others.row(row)...);
    }
}

/// Calls `use(row, i)` for each cell in order. If the mask `counted` is not null, leaves out cells
/// where the mask is 0.
template <typename Use>
void for_each_counted(const PlaneLayout& layout, const Mask* counted, const Use& use) {
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            if (counted == nullptr || counted->row(row)[i] != 0) use(row, i);
        }
    }
}

}  // namespace cascade
