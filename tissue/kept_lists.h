// Lists of neighbours that are kept while a few cells are found anew (internal to tissue/).
//
// Each list was found from marks: the place, the radius and the skin that each cell had when its
// neighbours were last looked for. Two cells that touch are in each other's lists as long as both
// are near their marks, whenever these were made.
#pragma once

#include "tissue/neighbour_search.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

class KeptLists {
public:
    /// Lists of all cells and the search that found them.
    void start(NeighbourLists lists, NeighbourSearch search);

    /// Gives some cells new marks, of which those from the present number of cells on are new
    /// cells. `ranks` are those of all cells; those of earlier ones must be what they were. Returns
    /// false, with everything as it was, if the lists of all cells should be found instead: the
    /// cells renewed are too many or too large, or they would have more than `most_links`.
    bool renew(std::span<const BoxedCell> cells, std::span<const std::uint32_t> ranks,
               double most_links);

    const NeighbourLists& lists() const { return lists_; }
    /// The widest that a cell may be (width_of()) that is renewed.
    double widest() const { return search_.widest(); }

private:
    static constexpr std::uint32_t no_slot = 0xffffffff;

    bool is_renewed(std::uint32_t cell) const {
        return cell < slots_.size() && slots_[cell] != no_slot;
    }
    void find(const BoxedCell& cell);
    void note_links(std::span<const BoxedCell> cells);
    std::span<const std::uint32_t> list_of(std::uint32_t cell) const;
    void merge(std::span<const std::uint32_t> ranks);
    void copy(std::uint32_t first, std::uint32_t last);
    void write(std::uint32_t cell, std::span<const std::uint32_t> neighbours);

    NeighbourSearch search_;
    NeighbourLists lists_, next_;
    std::vector<BoxedCell> renewed_;    ///< Marks of cells since start().
    std::vector<std::uint32_t> slots_;  ///< By cell: its place there, or no_slot.

    // Of one renewal.
    NeighbourKeys found_;
    std::vector<std::vector<std::uint32_t>> new_lists_;
    enum class Kind : std::uint8_t { kept, touched, renewed };
    std::vector<Kind> kinds_;
    std::vector<std::uint32_t> list_numbers_;  ///< By cell: its place in new_lists_.
    /// Cells that keep their list, and one that comes to it; in order of both.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> added_;
};

}  // namespace cascade
