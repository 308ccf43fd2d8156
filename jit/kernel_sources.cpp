// The loop level of every value, and what sources answer if they are asked at the wrong one.
#include "jit/kernel_sources.h"

#include "core/check.h"

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

llvm::Value* not_here() {
    CHECK(false, "sources are asked for values of their own loop level");
    return nullptr;
}

}  // namespace

llvm::Value* Sources::uniform(UniformSlot) { return not_here(); }
llvm::Value* Sources::hidden(std::uint64_t) { return not_here(); }
llvm::Value* Sources::cell_row() { return not_here(); }
llvm::Value* Sources::cell_slice() { return not_here(); }
llvm::Value* Sources::field(FieldSlot) { return not_here(); }
llvm::Value* Sources::laplacian(FieldSlot) { return not_here(); }
llvm::Value* Sources::neighbour(Neighbour) { return not_here(); }
llvm::Value* Sources::link_sum(const Instruction&) { return not_here(); }
llvm::Value* Sources::mask(MaskSlot) { return not_here(); }
llvm::Value* Sources::cell_column() { return not_here(); }

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
