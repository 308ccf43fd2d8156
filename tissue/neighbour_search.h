// The search for neighbours, and the boxes that it leaves for cells whose neighbours change
// (internal to tissue/).
#pragma once

#include "core/parallel.h"
#include "tissue/cell_boxes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Are cells so far apart in memory that they do not share a near cache?
inline bool is_far_link(std::uint32_t cell, std::uint32_t other) {
    constexpr std::uint32_t far_in_memory = 2048;
    return other - cell + far_in_memory > 2 * far_in_memory;
}

/// The cells in boxes for each octave of radii. A cell looks for those of its own octave and of
/// larger ones, so boxes are never much smaller than the distance that is searched.
class NeighbourSearch {
public:
    NeighbourSearch() = default;
    /// Throws std::bad_alloc.
    NeighbourSearch(const CellPlaces& cells, const NeighbourRule& rule, double skin);

    std::size_t count() const { return entries_.size(); }
    bool finds_nothing() const { return boxes_.empty(); }

    /// The keys of a cell's neighbours: first of those in larger octaves, whose number is returned,
    /// then of those in its own.
    std::size_t find(std::uint32_t cell, NeighbourKeys& found) const;
    /// The number of links, estimated from some of the cells.
    double estimated_links() const;

    /// Are all cells of one octave, so that find_all() can be called?
    bool has_one_octave() const { return boxes_.size() == 1; }
    /// How wide an entry may be for find_all(): as wide as that of some cell.
    double widest() const { return widest_; }
    /// The keys of all neighbours of an entry that need not be of a cell as it was when the search
    /// was made.
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

/// As find_neighbours() of cells, by a search that is there.
Result<NeighbourLists> find_neighbours(const NeighbourSearch& search,
                                       std::span<const std::uint32_t> ranks, double most_links,
                                       Team& team);

}  // namespace cascade
