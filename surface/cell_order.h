// Orders cells such that neighbours are close in memory and the cells of a slice of links
// (core/links.h) have similar numbers of links. order[k] is the old cell that becomes cell k.
#pragma once

#include "core/links.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Orders cells by their distance from a peripheral cell, counted in links, so that neighbours are
/// in adjacent levels (E. Cuthill and J. McKee, "Reducing the bandwidth of sparse symmetric
/// matrices", ACM 1969). The peripheral cell is found by the method of A. George and J. Liu, ACM
/// TOMS 5(3), 1979. Connected components follow each other. O(n).
std::vector<std::uint32_t> order_by_levels(const LinkList& links);

/// The order with which steps are fastest, according to measurements (docs/performance.md):
/// order_by_levels(), then group_by_links() in windows of 64 cells. Depends only on the links.
std::vector<std::uint32_t> order_for_steps(const LinkList& links);

/// Sorts each window of `window` cells stably by their numbers of links, in ascending order. A
/// slice of links is as long as its longest list, so this reduces padding.
void group_by_links(std::vector<std::uint32_t>& order, const LinkList& links, std::size_t window);

/// The same links after cells have been renumbered: cell k of the result is cell order[k] of
/// `links`. Sorts the links of each cell by neighbour.
LinkList renumbered(const LinkList& links, std::span<const std::uint32_t> order);

}  // namespace cascade
