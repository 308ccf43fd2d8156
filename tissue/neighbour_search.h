// The search for neighbours, and its boxes for cells whose neighbours change later (internal to
// tissue/).
#pragma once

#include "core/parallel.h"
#include "tissue/cell_boxes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Whether cells are so far apart in memory that they do not share a near cache.
inline bool is_far_link(std::uint32_t cell, std::uint32_t other) {
    constexpr std::uint32_t far_in_memory = 2048;
    return other - cell + far_in_memory > 2 * far_in_memory;
}

/// The cells in boxes for each octave of radii. A cell searches its own octave and larger ones, so
/// boxes are never much smaller than the distance searched.
class NeighbourSearch {
public:
    NeighbourSearch() = default;
    /// Throws std::bad_alloc.
    NeighbourSearch(const CellPlaces& cells, const NeighbourRule& rule, double skin);

    std::size_t count() const { return entries_.size(); }
    bool finds_nothing() const { return boxes_.empty(); }

    /// Finds the keys of a cell's neighbours: first those in larger octaves, whose number is
    /// returned, then those in its own.
    std::size_t find(std::uint32_t cell, NeighbourKeys& found) const;
    /// The number of links, estimated from some of the cells.
    double estimated_links() const;

    /// Whether all cells are of one octave, as find_all() requires.
    bool has_one_octave() const { return boxes_.size() == 1; }
    /// The largest width of an entry for find_all(): the width of the widest cell.
    double widest() const { return widest_; }
    /// Finds the keys of all neighbours of an entry, which may differ from all cells of the search.
    void find_all(const BoxedCell& entry, NeighbourKeys& found) const {
        boxes_[0].find(entry, found);
    }
    const NeighbourRule& rule() const { return rule_; }

private:
    NeighbourRule rule_;
    double widest_ = 0;
    std::vector<BoxedCell> entries_;  ///< By cell.
    std::vector<std::uint8_t> levels_;
    std::vector<CellBoxes> boxes_;  ///< From the largest cells to the smallest.
    std::vector<std::uint8_t> level_of_boxes_;
};

/// Does the same as find_neighbours() of cells, with an existing search.
Result<NeighbourLists> find_neighbours(const NeighbourSearch& search,
                                       std::span<const std::uint32_t> ranks, double most_links,
                                       Team& team);

}  // namespace cascade
