// The search for neighbours. It keeps its boxes for later searches for the cells whose neighbours
// change (internal to tissue/).
#pragma once

#include "core/parallel.h"
#include "tissue/cell_boxes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Whether two cells are so far apart in memory that a core's first caches seldom hold both.
inline bool is_far_link(std::uint32_t cell, std::uint32_t other) {
    constexpr std::uint32_t far_in_memory = 2048;
    return other - cell + far_in_memory > 2 * far_in_memory;
}

/// Finds neighbours by boxes. There is one set of boxes for each octave of radii, that is, for
/// radii that differ by less than a factor of two. A cell searches the boxes of its octave and of
/// larger cells, so boxes are never much smaller than the search distance.
class NeighbourSearch {
public:
    NeighbourSearch() = default;
    /// Puts the cells into boxes. Throws std::bad_alloc.
    NeighbourSearch(const CellPlaces& cells, const NeighbourRule& rule, double skin);

    std::size_t count() const { return entries_.size(); }
    bool finds_nothing() const { return boxes_.empty(); }

    /// Finds the neighbours of a cell. First come the neighbours in octaves of larger cells, then
    /// the neighbours in the cell's own octave. Returns the number of neighbours in octaves of
    /// larger cells.
    std::size_t find(std::uint32_t cell, NeighbourKeys& found) const;
    /// The number of links, estimated from a sample of cells.
    double estimated_links() const;

    /// Whether all cells are of one octave, as find_all() requires.
    bool has_one_octave() const { return boxes_.size() == 1; }
    /// The largest width_of() that is allowed in find_all(): the width of the widest cell.
    double widest() const { return widest_; }
    /// Finds all neighbours of an entry, which need not be a cell of the search.
    void find_all(const BoxedCell& entry, NeighbourKeys& found) const {
        boxes_[0].find(entry, found);
    }
    const NeighbourRule& rule() const { return rule_; }

private:
    NeighbourRule rule_;
    double widest_ = 0;
    std::vector<BoxedCell> entries_;  ///< The data of each cell.
    std::vector<std::uint8_t> levels_;
    std::vector<CellBoxes> boxes_;  ///< In descending order of the cells' radii.
    std::vector<std::uint8_t> level_of_boxes_;
};

/// Does the same as find_neighbours() in tissue/neighbours.h, with boxes that exist already.
Result<NeighbourLists> find_neighbours(const NeighbourSearch& search,
                                       std::span<const std::uint32_t> ranks, double most_links,
                                       Team& team);

}  // namespace cascade
