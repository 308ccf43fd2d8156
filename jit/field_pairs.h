// Pairs of the fields that a kernel reads over links.
//
// Internal to jit/. Before native code computes rows of linked cells, it copies the rows to which
// their links lead and puts each pair's numbers side by side, so that one access of 64 bits reads
// the numbers of both fields at a neighbour. Such accesses bound the loop over links.
#pragma once

#include "ir/cell_kernel.h"

#include <array>
#include <set>
#include <vector>

namespace cascade {

using FieldPair = std::array<FieldSlot, 2>;

/// In ascending order of slots. If their number is odd, the last one has no pair. Only kernels of
/// binary32 have pairs.
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
