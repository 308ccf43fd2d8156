// The loops around a kernel's code in which executors that make code compute its values.
#pragma once

#include "ir/cell_kernel.h"

#include <vector>

namespace cascade {

/// The loop in which a value is computed.
enum class LoopLevel : std::uint8_t {
    call,  ///< In none: once in a call. It depends on constants and uniforms alone.
    row,   ///< Once in a row.
    cell,  ///< For each vector of cells.
    link,  ///< For each link of these cells.
};

/// The loop level of every instruction of a kernel.
IdVector<ValueId, LoopLevel> loop_levels_of(const CellKernel& kernel);

/// A loop over the links of cells: all reductions that need the same number of loops before it.
/// What it has in common with another loop is computed in both.
struct LinkLoop {
    std::vector<ValueId> before;      ///< Values of cells that it needs and no earlier loop does.
    std::vector<ValueId> values;      ///< Of links.
    std::vector<ValueId> reductions;  ///< Of these or other values.
};

/// What is computed for cells, in this order: each loop, then all other values of cells. Each list
/// is in ascending order.
struct CellSchedule {
    std::vector<LinkLoop> loops;
    std::vector<ValueId> after;
};
CellSchedule cell_schedule_of(const CellKernel& kernel, const IdVector<ValueId, LoopLevel>& levels);

}  // namespace cascade
