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

    /// Gives some cells new marks. `ranks` are those of all cells that there are now. Where cells
    /// have been born, have died or have moved in memory, those that are in places of others or in
    /// new ones must be among `cells`; the others are in the order of ranks that they were in.
    /// Returns false, with everything as it was, if the lists of all cells should be found instead:
    /// the cells renewed are too many or too large, or they would have more than `most_links`.
    bool renew(std::span<const BoxedCell> cells, std::span<const std::uint32_t> ranks,
               double most_links);

    const NeighbourLists& lists() const { return lists_; }
    /// By cell: did renew() change its list?
    std::vector<bool> changed() const;
    /// The widest that a cell may be (width_of()) that is renewed.
    double widest() const { return search_.widest(); }

private:
    static constexpr std::uint32_t no_slot = 0xffffffff, gone = 0xfffffffe;

    /// Is another cell, or none, in the place where the search found one?
    bool is_renewed(std::uint32_t cell) const { return slots_[cell] != no_slot; }
    void forget(std::uint32_t cell);
    void find(const BoxedCell& cell, std::span<const std::uint32_t> ranks);
    void note_links(std::span<const BoxedCell> cells, std::uint32_t count);
    std::span<const std::uint32_t> list_of(std::uint32_t cell) const;
    void merge(std::span<const std::uint32_t> ranks);
    void copy(std::uint32_t first, std::uint32_t last);
    void write(std::uint32_t cell, std::span<const std::uint32_t> neighbours);

    NeighbourSearch search_;
    NeighbourLists lists_, next_;
    std::vector<BoxedCell> renewed_;  ///< Marks of cells since start().
    /// By place in memory: that in renewed_, no_slot, or `gone` if there is no cell any more.
    std::vector<std::uint32_t> slots_;

    // Of one renewal.
    NeighbourKeys found_;
    std::vector<std::vector<std::uint32_t>> new_lists_;
    enum class Kind : std::uint8_t { kept, touched, renewed, gone };
    std::vector<Kind> kinds_;
    std::vector<std::uint32_t> list_numbers_;  ///< By cell: its place in new_lists_.
    /// Cells that keep their list, and one that comes to it; in order of both.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> added_;
};

}  // namespace cascade
