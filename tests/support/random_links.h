// Random links between cells.
#pragma once

#include "core/links.h"

#include <cstddef>
#include <cstdint>

namespace cascade::test {

/// Links of each cell to random others: mostly 0 to 9 links, for a few cells 70, and for some
/// ranges of cells none. Weights and gradients are in [−1, 1), except for a share of zeros, NaN,
/// infinities, denormals and huge numbers. A pure function of its arguments.
LinkList random_links(std::size_t cells, std::uint64_t seed, int trouble_percent = 0);

}  // namespace cascade::test
