// The search for neighbours. Its boxes are kept for later searches for cells whose neighbours
// change (internal to tissue/).
#pragma once

#include "core/parallel.h"
#include "tissue/cell_boxes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Whether two cells are far apart in memory, so that they are seldom in a core's first caches
/// together.
inline bool is_far_link(std::uint32_t cell, std::uint32_t other) {
    constexpr std::uint32_t far_in_memory = 2048;
    return other - cell + far_in_memory > 2 * far_in_memory;
}

/// Finds neighbours by boxes. There is one set of boxes for each octave of radii, that is, for
/// radii that differ by less than a factor of two. A cell searches the boxes of its octave and
/// of larger cells, so boxes are never much smaller than the distance searched.
class NeighbourSearch {
public:
    NeighbourSearch() = default;
    /// Puts the cells into boxes. Throws std::bad_alloc.
    NeighbourSearch(const CellPlaces& cells, const NeighbourRule& rule, double skin);

    std::size_t count() const { return entries_.size(); }
    bool finds_nothing() const { return boxes_.empty(); }

    /// Finds the keys of a cell's neighbours. First come the neighbours in octaves of larger cells,
    /// then those in the cell's own octave. Returns the number of the former.
    std::size_t find(std::uint32_t cell, NeighbourKeys& found) const;
    /// The number of links, estimated from a sample of cells.
    double estimated_links() const;

    /// Whether all cells are of one octave, as find_all() requires.
    bool has_one_octave() const { return boxes_.size() == 1; }
    /// The largest width_of() that is allowed in find_all(): the width of the widest cell.
    double widest() const { return widest_; }
    /// Finds the keys of all neighbours of an entry, which need not be a cell of the search.
    void find_all(const BoxedCell& entry, NeighbourKeys& found) const {
        boxes_[0].find(entry, found);
    }
    const NeighbourRule& rule() const { return rule_; }

private:
    NeighbourRule rule_;
    double widest_ = 0;
    std::vector<BoxedCell> entries_;  ///< The data of each cell.
    std::vector<std::uint8_t> levels_;
    std::vector<CellBoxes> boxes_;  ///< From the largest cells to the smallest.
    std::vector<std::uint8_t> level_of_boxes_;
};

/// Does the same as find_neighbours() in tissue/neighbours.h, with an existing search.
Result<NeighbourLists> find_neighbours(const NeighbourSearch& search,
                                       std::span<const std::uint32_t> ranks, double most_links,
                                       Team& team);

}  // namespace cascade
