// Finds an order in which values that read each other can be computed (internal to lang/).
#pragma once

#include <cstdint>
#include <vector>

namespace cascade {

/// Element i lists the numbers of the values that must be computed before value i.
using Dependencies = std::vector<std::vector<std::uint32_t>>;

struct Order {
    std::vector<std::uint32_t> order;  ///< All values. Each comes after the values that it reads.
                                       ///< Meaningless if there are cycles.
    /// Each value of a cycle reads the next one, and the last reads the first. No value is in two
    /// cycles.
    std::vector<std::vector<std::uint32_t>> cycles;
};

/// A depth-first topological sort. Its stack is explicit, so deep dependencies cannot overflow the
/// program's stack. Values stay in the order of their numbers as far as possible.
Order topological_order(const Dependencies& reads);

}  // namespace cascade
