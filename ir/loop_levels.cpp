// A value is computed in the innermost loop that one of its operands needs.
#include "ir/loop_levels.h"

#include <algorithm>

namespace cascade {
namespace {

LoopLevel level_of_source(Op op) {
    switch (op) {
        case Op::field:
        case Op::laplacian:
        case Op::neighbour:
        case Op::link_flow:
        case Op::link_squares:
        case Op::gradient_x:
        case Op::gradient_y:
        case Op::gradient_z:
        case Op::mask:
        case Op::cell_column: return LoopLevel::cell;
        case Op::cell_row:
        case Op::cell_slice: return LoopLevel::row;
        default: return LoopLevel::call;
    }
}

}  // namespace

IdVector<ValueId, LoopLevel> loop_levels_of(const CellKernel& kernel) {
    IdVector<ValueId, LoopLevel> levels;
    levels.reserve(kernel.code.size());
    for (const Instruction& instruction : kernel.code) {
        LoopLevel level = level_of_source(instruction.op);
        for (int k = 0; k < info(instruction.op).arity; ++k) {
            level = std::max(level, levels[instruction.operands[static_cast<std::size_t>(k)]]);
        }
        levels.push_back(level);
    }
    return levels;
}

}  // namespace cascade
