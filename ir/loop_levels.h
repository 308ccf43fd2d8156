// The loops around a kernel's code in which compiling executors compute its values.
#pragma once

#include "ir/cell_kernel.h"

#include <vector>

namespace cascade {

/// The loop in which a value is computed.
enum class LoopLevel : std::uint8_t {
    call,  ///< Outside all loops, once per call, from constants and uniforms alone.
    row,   ///< Once per row.
    cell,  ///< Once per vector of cells.
    link,  ///< Once per link of these cells.
};

/// The loop level of every instruction of a kernel.
IdVector<ValueId, LoopLevel> loop_levels_of(const CellKernel& kernel);

/// A loop over the links of cells: all reductions that need the same number of earlier loops.
/// Values shared with another loop are computed in both.
struct LinkLoop {
    std::vector<ValueId> before;      ///< Values of cells that it needs first.
    std::vector<ValueId> values;      ///< Values of links.
    std::vector<ValueId> reductions;  ///< Reductions of these or other values.
};

/// The values computed for cells, in this order: each loop, then all other values of cells. Each
/// list is in ascending order.
struct CellSchedule {
    std::vector<LinkLoop> loops;
    std::vector<ValueId> after;
};
CellSchedule cell_schedule_of(const CellKernel& kernel, const IdVector<ValueId, LoopLevel>& levels);

}  // namespace cascade
