// Finds an order in which values that read each other can be computed (internal to lang/).
#pragma once

#include <cstdint>
#include <vector>

namespace cascade {

/// Element i lists the numbers of all values that must be computed before value i.
using Dependencies = std::vector<std::vector<std::uint32_t>>;

struct Order {
    /// All values, each after the values that it reads. Meaningless if there are cycles.
    std::vector<std::uint32_t> order;
    /// In each cycle, every value reads the next value, and the last value reads the first. No
    /// value is in two cycles.
    std::vector<std::vector<std::uint32_t>> cycles;
};

/// Sorts values topologically, depth first. The stack is explicit, so deep dependencies cannot
/// overflow the program's stack. As far as possible, values stay in the order of their numbers.
Order topological_order(const Dependencies& reads);

}  // namespace cascade
