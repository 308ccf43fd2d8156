// The order in which values that read each other can be computed (internal to lang/).
#pragma once

#include <cstdint>
#include <vector>

namespace cascade {

/// What reads what: `reads[i]` are the numbers of the values that value i needs first.
using Dependencies = std::vector<std::vector<std::uint32_t>>;

struct Order {
    std::vector<std::uint32_t> order;  ///< All values, each after those it reads.
    /// Cycles: each reads the next and the last reads the first. No value is in two of them. Where
    /// there is one `order` has no meaning.
    std::vector<std::vector<std::uint32_t>> cycles;
};

/// Depth-first topological sort with a stack of its own: values stay in order of their numbers as
/// far as possible, and no depth of dependencies overflows anything.
Order topological_order(const Dependencies& reads);

}  // namespace cascade
