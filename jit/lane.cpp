// Which loop a value belongs to, and what a lane answers where it is asked in the wrong one.
#include "jit/emit_body.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {
namespace {

Level level_of_source(Op op) {
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
        case Op::cell_column: return Level::cell;
        case Op::cell_row:
        case Op::cell_slice: return Level::row;
        default: return Level::call;
    }
}

llvm::Value* not_here() {
    CHECK(false, "a lane is asked for values of its own level");
    return nullptr;
}

}  // namespace

llvm::Value* Lane::uniform(std::uint32_t) { return not_here(); }
llvm::Value* Lane::hidden(std::uint64_t) { return not_here(); }
llvm::Value* Lane::cell_row() { return not_here(); }
llvm::Value* Lane::cell_slice() { return not_here(); }
llvm::Value* Lane::field(std::uint32_t) { return not_here(); }
llvm::Value* Lane::laplacian(std::uint32_t) { return not_here(); }
llvm::Value* Lane::neighbour(Neighbour) { return not_here(); }
llvm::Value* Lane::link_sum(const Instruction&) { return not_here(); }
llvm::Value* Lane::mask(std::uint32_t) { return not_here(); }
llvm::Value* Lane::cell_column() { return not_here(); }

std::vector<Level> levels_of(const CellKernel& kernel) {
    std::vector<Level> levels;
    levels.reserve(kernel.code.size());
    for (const Instruction& instruction : kernel.code) {
        Level level = level_of_source(instruction.op);
        for (int k = 0; k < info(instruction.op).arity; ++k) {
            level = std::max(level, levels[instruction.operands[static_cast<std::size_t>(k)]]);
        }
        levels.push_back(level);
    }
    return levels;
}

}  // namespace cascade
