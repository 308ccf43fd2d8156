// Pairs of fields that a kernel reads over links.
//
// Internal to jit/. Before native code computes rows of linked cells, it copies the rows to which
// their links lead. The copy has the numbers of both fields of a pair side by side, so one access
// of 64 bits reads both numbers of a neighbour. The number of such accesses limits the speed of the
// loop over links.
#pragma once

#include "ir/cell_kernel.h"

#include <array>
#include <set>
#include <vector>

namespace cascade {

using FieldPair = std::array<FieldSlot, 2>;

/// The pairs, in ascending order of slots. If the number of fields is odd, the last field has no
/// pair. Only kernels of binary32 have pairs.
inline std::vector<FieldPair> field_pairs(const CellKernel& kernel) {
    if (kernel.precision != Precision::single) return {};
    std::set<FieldSlot> slots;
    for (const Instruction& instruction : kernel.code) {
        if (!is_link_sum(instruction.op) && instruction.op != Op::theirs) continue;
        const Flow flow = Flow::with(instruction.payload);
        slots.insert(flow.of);
        if (instruction.op == Op::link_flow) slots.insert(flow.factor);
    }
    std::vector<FieldPair> pairs;
    while (slots.size() > 1) {
        const FieldSlot first = slots.extract(slots.begin()).value();
        pairs.push_back({first, slots.extract(slots.begin()).value()});
    }
    return pairs;
}

}  // namespace cascade
