// Random links between cells.
#pragma once

#include "core/links.h"

#include <cstddef>
#include <cstdint>

namespace cascade::test {

/// Links of each cell to random others: mostly 0 to 9 links, 70 for a few cells, and none for some
/// ranges of cells. Weights and gradients are in [−1, 1), but `trouble_percent` percent of them are
/// zeros, NaN, infinities, denormals and huge numbers. A pure function of its arguments.
LinkList random_links(std::size_t cells, std::uint64_t seed, int trouble_percent = 0);

}  // namespace cascade::test
