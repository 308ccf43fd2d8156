// The order in which values that read each other can be computed (internal to lang/).
#pragma once

#include <cstdint>
#include <vector>

namespace cascade {

/// Dependencies: `reads[i]` are the numbers of the values that value i needs first.
using Dependencies = std::vector<std::vector<std::uint32_t>>;

struct Order {
    std::vector<std::uint32_t> order;  ///< All values, each after those it reads.
    /// Each value of a cycle reads the next one, and the last reads the first. No value is in two
    /// cycles. If there is one, `order` is meaningless.
    std::vector<std::vector<std::uint32_t>> cycles;
};

/// Depth-first topological sort with an explicit stack, so that no depth of dependencies overflows.
/// Values stay in the order of their numbers as far as possible.
Order topological_order(const Dependencies& reads);

}  // namespace cascade
