// Neighbour lists that survive while a few cells are found again (internal to tissue/).
//
// Each list was found from marks: each cell's position, radius and skin at its last search. Two
// cells that touch are in each other's lists as long as both are near their marks, whenever these
// were made.
#pragma once

#include "tissue/neighbour_search.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

class KeptLists {
public:
    /// Takes the lists of all cells and the search that found them.
    void start(NeighbourLists lists, NeighbourSearch search);

    /// Gives some cells new marks. `ranks` belong to all present cells. After births, deaths or
    /// moves in memory, `cells` must include all with a new index. The others must have kept their
    /// order of ranks. Returns false and changes nothing if all lists should be found again: the
    /// renewed cells are too many or too large, or would have more than `most_links`.
    bool renew(std::span<const BoxedCell> cells, std::span<const std::uint32_t> ranks,
               double most_links);

    const NeighbourLists& lists() const { return lists_; }
    /// By cell: whether renew() changed its list.
    std::vector<bool> changed() const;
    /// The largest width_of() of a cell that can be renewed.
    double widest() const { return search_.widest(); }

private:
    static constexpr std::uint32_t no_slot = 0xffffffff, gone = 0xfffffffe;

    /// Whether the cell has been renewed, replaced or removed since the search.
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
    /// By index in memory: the index in renewed_, no_slot, or `gone` if there is no cell any more.
    std::vector<std::uint32_t> slots_;

    // Used within one renewal.
    NeighbourKeys found_;
    std::vector<std::vector<std::uint32_t>> new_lists_;
    enum class Kind : std::uint8_t { kept, touched, renewed, gone };
    std::vector<Kind> kinds_;
    std::vector<std::uint32_t> list_numbers_;  ///< By cell: its index in new_lists_.
    /// A new neighbour for a cell whose list is kept. Sorted by cell, then by neighbour.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> added_;
};

}  // namespace cascade
