// In which order cells are numbered, so that those of a slice of links (core/links.h) find their
// neighbours near each other in memory and have as many of them. Orders are lists of old numbers:
// order[k] is the cell that becomes cell k.
#pragma once

#include "core/links.h"
#include "core/vector3.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Along D. Hilbert's curve through the cube around all positions, of 2^21 boxes a side (by
/// J. Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004). Cells in
/// one box keep their order, and so do cells without a place in space (NaN), in front. O(n log n).
std::vector<std::uint32_t> order_along_curve(std::span<const Vector3d> positions);

/// By distance from a cell at the rim, counted in links, so that neighbours lie in three bands (E.
/// Cuthill and J. McKee, "Reducing the bandwidth of sparse symmetric matrices", ACM 1969; the rim
/// is found as by A. George and J. Liu, ACM TOMS 5(3), 1979). Pieces that no link connects follow
/// each other. O(n).
std::vector<std::uint32_t> order_by_levels(const LinkList& links);

/// The order in which steps are fastest, as measured (docs/performance.md): by levels, grouped in
/// windows of 64 cells. Depends on the links only.
std::vector<std::uint32_t> order_for_steps(const LinkList& links);

/// Sorts each stretch of `window` cells by their number of links, the fewest first; equals keep
/// their order. A slice is as long as its longest list, so that what fills up shrinks.
void group_by_links(std::vector<std::uint32_t>& order, const LinkList& links, std::size_t window);

/// The same links with cells numbered by an order; those of a cell are sorted by their neighbours.
LinkList renumbered(const LinkList& links, std::span<const std::uint32_t> order);

}  // namespace cascade
