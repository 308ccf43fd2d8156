// Neighbour lists that stay valid when the lists of a few cells are built again (internal to
// tissue/).
//
// Lists are built from marks. A cell's mark is its position, radius and skin at its last search.
// Two cells that touch are in each other's lists as long as each has moved by at most its slack
// from its mark. The marks may have been made at different times.
#pragma once

#include "tissue/neighbour_search.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

class KeptLists {
public:
    /// Begins with these lists of all cells, and with the search that found them.
    void start(NeighbourLists lists, NeighbourSearch search);

    /// Gives some cells new marks and builds their lists. `ranks` has the rank of every present
    /// cell. After births, deaths or moves in memory, `cells` must include all cells with a new
    /// index. All other cells must have kept the order of their ranks. Returns false and changes
    /// nothing if all lists should be built again, because the renewed cells are too many or too
    /// large, or would have more than `most_links` links.
    bool renew(std::span<const BoxedCell> cells, std::span<const std::uint32_t> ranks,
               double most_links);

    const NeighbourLists& lists() const { return lists_; }
    /// Whether the last renew() changed the list of each cell.
    std::vector<bool> changed() const;
    /// The largest width_of() that a cell may have in renew().
    double widest() const { return search_.widest(); }

private:
    static constexpr std::uint32_t no_slot = 0xffffffff, gone = 0xfffffffe;

    /// Whether the cell has been renewed, replaced or removed since the last search of all cells.
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
    std::vector<BoxedCell> renewed_;  ///< The marks of the cells renewed since start().
    /// For each index in memory: the index in renewed_; `no_slot` if the cell has not been renewed;
    /// `gone` if this index no longer belongs to a cell.
    std::vector<std::uint32_t> slots_;

    // The members below are used within one renewal.
    NeighbourKeys found_;
    std::vector<std::vector<std::uint32_t>> new_lists_;
    enum class Kind : std::uint8_t { kept, touched, renewed, gone };
    std::vector<Kind> kinds_;
    std::vector<std::uint32_t> list_numbers_;  ///< The index of each cell in new_lists_.
    /// New neighbours of the cells whose other neighbours stay. Each pair is a cell and its new
    /// neighbour. Sorted by cell, then by neighbour.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> added_;
};

}  // namespace cascade
