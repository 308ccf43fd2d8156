// Divides the rows of a patch into calls of a kernel's function.
#pragma once

#include "core/grid.h"
#include "core/patch.h"
#include "ir/backend.h"

#include <algorithm>
#include <cstdint>

namespace cascade {

/// Whether kernels copy columns to the halo. In volumes kernels do not, because reading the rows of
/// other slices takes most of the time.
constexpr bool kernels_fill_columns(Stencil stencil) {
    return stencil.x && !stencil.z && !stencil.links;
}

/// The columns that a call copies to halo columns −1 and `width` of its rows. If the call does not
/// compute whole rows, or if `arguments` names no columns, the result is {-1, -1}, which means no
/// copy.
template <typename Number>
HaloColumns columns_to_fill(const KernelArgumentsOf<Number>& arguments, ColumnRange columns) {
    const bool is_whole = columns.begin == 0 && columns.end == arguments.layout.width;
    const HaloColumns none{-1, -1};
    return is_whole ? arguments.columns.value_or(none) : none;
}

/// Calls `call(rows, slice)` for each slice that contains some of the rows. The rows passed to
/// `call` are numbered by their position in memory, which counts halo rows, too.
template <typename Call>
void for_each_slice(const PlaneLayout& layout, RowRange rows, const Call& call) {
    while (!rows.empty()) {
        const std::int64_t slice = rows.begin / layout.height;
        const std::int64_t end = std::min(rows.end, (slice + 1) * layout.height);
        const std::int64_t halo_rows = slice * (layout.slice_rows() - layout.height);
        call(RowRange{rows.begin + halo_rows, end + halo_rows}, slice);
        rows.begin = end;
    }
}

}  // namespace cascade
