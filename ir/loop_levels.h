// The loops around a kernel's code in which executors that make code compute its values.
#pragma once

#include "ir/cell_kernel.h"

namespace cascade {

/// The loop in which a value is computed.
enum class LoopLevel : std::uint8_t {
    call,  ///< In none: once in a call. It depends on constants and uniforms alone.
    row,   ///< Once in a row.
    cell,  ///< For each vector of cells.
};

/// The loop level of every instruction of a kernel.
IdVector<ValueId, LoopLevel> loop_levels_of(const CellKernel& kernel);

}  // namespace cascade
