// The nested loops around a kernel's code, and the loop in which compiled code computes each value.
#pragma once

#include "ir/cell_kernel.h"

#include <vector>

namespace cascade {

/// The loop in which a value is computed.
enum class LoopLevel : std::uint8_t {
    /// Outside all loops, once per call. For values that depend only on constants and uniforms.
    call,
    row,   ///< Once per row.
    cell,  ///< Once per vector of cells.
    link,  ///< Once per link of the cells in a vector.
};

/// The loop level of every instruction of a kernel.
IdVector<ValueId, LoopLevel> loop_levels_of(const CellKernel& kernel);

/// One loop over the links of cells. Loop k, counted from 0, computes the reductions that need the
/// results of k earlier loops. A value of links that several loops need is computed in each of
/// these loops.
struct LinkLoop {
    /// Values of cells that the loop needs. They are computed before the loop.
    std::vector<ValueId> before;
    std::vector<ValueId> values;      ///< Values of links, computed in the loop.
    std::vector<ValueId> reductions;  ///< Reductions of values of links or of cells.
};

/// The order in which values of cells are computed: first loop by loop, then the values of cells
/// that no loop needs (`after`). Each list is in ascending order.
struct CellSchedule {
    std::vector<LinkLoop> loops;
    std::vector<ValueId> after;
};
CellSchedule cell_schedule_of(const CellKernel& kernel, const IdVector<ValueId, LoopLevel>& levels);

}  // namespace cascade
