// Assigns each value to the innermost of the loops in which its operands are computed.
#include "ir/loop_levels.h"

#include <algorithm>
#include <span>

namespace cascade {
namespace {

LoopLevel level_of_source(Op op) {
    switch (op) {
        case Op::field:
        case Op::laplacian:
        case Op::neighbour:
        case Op::link_flow:
        case Op::link_squares:
        case Op::link_weighted:
        case Op::gradient_x:
        case Op::gradient_y:
        case Op::gradient_z:
        case Op::mask:
        case Op::cell_column: return LoopLevel::cell;
        case Op::theirs: return LoopLevel::link;
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
        levels.push_back(is_link_reduction(instruction.op) ? LoopLevel::cell : level);
    }
    return levels;
}

CellSchedule cell_schedule_of(const CellKernel& kernel,
                              const IdVector<ValueId, LoopLevel>& levels) {
    const auto operands = [&](ValueId id) {
        const Instruction& instruction = kernel.code[id];
        return std::span(instruction.operands)
            .first(static_cast<std::size_t>(info(instruction.op).arity));
    };
    CellSchedule schedule;
    // For each value, how many loops must be complete before it can be computed.
    IdVector<ValueId, std::size_t> loops(kernel.code.size());
    IdVector<ValueId, bool> is_scheduled(kernel.code.size());
    for (const ValueId id : kernel.code.ids()) {
        for (const ValueId operand : operands(id)) loops[id] = std::max(loops[id], loops[operand]);
        if (!is_link_reduction(kernel.code[id].op)) continue;
        is_scheduled[id] = true;
        const std::size_t loop = loops[id]++;
        schedule.loops.resize(std::max(schedule.loops.size(), loop + 1));
        schedule.loops[loop].reductions.push_back(id);
    }
    for (LinkLoop& loop : schedule.loops) {
        IdVector<ValueId, bool> is_needed(kernel.code.size());
        for (const ValueId id : loop.reductions) is_needed[operands(id)[0]] = true;
        for (const ValueId id : kernel.code.ids_backwards()) {
            if (!is_needed[id] || is_scheduled[id] || levels[id] < LoopLevel::cell) continue;
            for (const ValueId operand : operands(id)) is_needed[operand] = true;
            if (levels[id] == LoopLevel::link) {
                loop.values.push_back(id);
            } else {
                loop.before.push_back(id);
                is_scheduled[id] = true;
            }
        }
        std::reverse(loop.values.begin(), loop.values.end());
        std::reverse(loop.before.begin(), loop.before.end());
    }
    for (const ValueId id : kernel.code.ids()) {
        if (levels[id] == LoopLevel::cell && !is_scheduled[id]) schedule.after.push_back(id);
    }
    return schedule;
}

}  // namespace cascade
