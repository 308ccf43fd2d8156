// Searches for neighbours of renewed cells in the boxes of the last search and among the renewed
// cells themselves. The boxes still contain the old marks of renewed cells.
#include "tissue/kept_lists.h"

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

/// All lists are built again when, since the last search of all cells, more than one in this many
/// cells has been renewed.
constexpr std::size_t cells_of_a_renewed = 8;
/// At most this many cells are always renewed one by one.
constexpr std::size_t few_cells = 32;

std::size_t far_links(std::uint32_t cell, std::span<const std::uint32_t> list) {
    return static_cast<std::size_t>(std::count_if(
        list.begin(), list.end(), [&](std::uint32_t other) { return is_far_link(cell, other); }));
}

}  // namespace

void KeptLists::start(NeighbourLists lists, NeighbourSearch search) {
    lists_ = std::move(lists);
    search_ = std::move(search);
    renewed_.clear();
    slots_.assign(lists_.ends.size(), no_slot);
}

bool KeptLists::renew(std::span<const BoxedCell> cells, std::span<const std::uint32_t> ranks,
                      double most_links) {
    const std::size_t most = std::max(few_cells, ranks.size() / cells_of_a_renewed);
    if (!search_.has_one_octave() || renewed_.size() + cells.size() > most) return false;
    for (const BoxedCell& cell : cells) {
        if (!(width_of(cell, search_.rule()) <= search_.widest())) return false;
    }
    // There must be room for links even if every cell is a neighbour of every renewed cell.
    const auto links = static_cast<double>(lists_.neighbours.size());
    if (links + 2.0 * static_cast<double>(cells.size() * ranks.size()) > most_links) return false;
    slots_.resize(std::max(slots_.size(), ranks.size()), no_slot);
    const auto count = static_cast<std::uint32_t>(ranks.size());
    for (std::uint32_t cell = count; cell < lists_.ends.size(); ++cell) forget(cell);
    for (const BoxedCell& cell : cells) {
        std::uint32_t& slot = slots_[cell.cell];
        if (slot < renewed_.size()) {
            renewed_[slot] = cell;
        } else {
            slot = static_cast<std::uint32_t>(renewed_.size());
            renewed_.push_back(cell);
        }
    }
    new_lists_.clear();
    for (const BoxedCell& cell : cells) find(cell, ranks);
    note_links(cells, count);
    merge(ranks);
    return true;
}

/// Marks an index as `gone`, because it no longer belongs to a cell.
void KeptLists::forget(std::uint32_t cell) {
    const std::uint32_t slot = std::exchange(slots_[cell], gone);
    if (slot >= renewed_.size()) return;
    renewed_[slot] = renewed_.back();
    renewed_.pop_back();
    if (slot < renewed_.size()) slots_[renewed_[slot].cell] = slot;
}

/// Finds the neighbours of a cell and adds its new list.
void KeptLists::find(const BoxedCell& cell, std::span<const std::uint32_t> ranks) {
    found_.clear();
    search_.find_all(cell, found_);
    found_.leave_out([this](std::uint32_t other) { return is_renewed(other); });
    found_.rank(ranks);
    const bool is_periodic = repeats(search_.rule());
    for (const BoxedCell& other : renewed_) {
        const bool is_near = is_periodic ? are_near<true>(cell, other, search_.rule())
                                         : are_near<false>(cell, other, search_.rule());
        if (is_near && other.cell != cell.cell) found_.add(other.cell, ranks[other.cell]);
    }
    const std::span<const std::uint32_t> sorted = found_.sorted();
    new_lists_.emplace_back(sorted.begin(), sorted.end());
}

/// Finds which lists change because of `cells`, besides their own. `count` is the number of cells.
void KeptLists::note_links(std::span<const BoxedCell> cells, std::uint32_t count) {
    kinds_.assign(slots_.size(), Kind::kept);
    list_numbers_.resize(slots_.size());
    for (std::uint32_t k = 0; k < cells.size(); ++k) {
        kinds_[cells[k].cell] = Kind::renewed;
        list_numbers_[cells[k].cell] = k;
    }
    const auto touch = [&](std::uint32_t cell) {
        for (const std::uint32_t other : list_of(cell)) {
            if (kinds_[other] == Kind::kept) kinds_[other] = Kind::touched;
        }
    };
    for (std::uint32_t cell = count; cell < kinds_.size(); ++cell) {
        kinds_[cell] = Kind::gone;
        touch(cell);
    }
    added_.clear();
    for (std::uint32_t k = 0; k < cells.size(); ++k) {
        const std::uint32_t cell = cells[k].cell;
        touch(cell);
        for (const std::uint32_t other : new_lists_[k]) {
            if (kinds_[other] == Kind::renewed) continue;
            kinds_[other] = Kind::touched;
            added_.emplace_back(other, cell);
        }
    }
    std::sort(added_.begin(), added_.end());
}

/// The old list of a cell; empty for a new cell.
std::span<const std::uint32_t> KeptLists::list_of(std::uint32_t cell) const {
    if (cell >= lists_.ends.size()) return {};
    const std::size_t begin = cell == 0 ? 0 : lists_.ends[cell - 1];
    return {lists_.neighbours.data() + begin, lists_.ends[cell] - begin};
}

void KeptLists::merge(std::span<const std::uint32_t> ranks) {
    next_.ends.clear();
    next_.neighbours.clear();
    next_.ends.reserve(ranks.size());
    next_.neighbours.reserve(lists_.neighbours.size() + 2 * added_.size());
    next_.far_links = lists_.far_links;
    const auto count = static_cast<std::uint32_t>(ranks.size());
    for (std::uint32_t cell = count; cell < lists_.ends.size(); ++cell) {
        next_.far_links -= far_links(cell, list_of(cell));
    }
    std::size_t next_added = 0;
    std::vector<std::uint32_t> merged;
    for (std::uint32_t cell = 0; cell < count; ++cell) {
        if (kinds_[cell] == Kind::renewed) {
            write(cell, new_lists_[list_numbers_[cell]]);
        } else if (kinds_[cell] == Kind::kept) {
            const std::uint32_t first = cell;
            while (cell + 1 < count && kinds_[cell + 1] == Kind::kept) ++cell;
            copy(first, cell);
        } else {
            merged.clear();
            for (const std::uint32_t other : list_of(cell)) {
                if (kinds_[other] <= Kind::touched) merged.push_back(other);
            }
            for (; next_added < added_.size() && added_[next_added].first == cell; ++next_added) {
                merged.push_back(added_[next_added].second);
            }
            std::sort(merged.begin(), merged.end(),
                      [&](std::uint32_t a, std::uint32_t b) { return ranks[a] < ranks[b]; });
            write(cell, merged);
        }
    }
    std::swap(lists_, next_);
}

std::vector<bool> KeptLists::changed() const {
    std::vector<bool> result(lists_.ends.size());
    for (std::size_t cell = 0; cell < result.size(); ++cell) {
        result[cell] = kinds_[cell] != Kind::kept;
    }
    return result;
}

/// Copies the lists of cells [first, last) unchanged.
void KeptLists::copy(std::uint32_t first, std::uint32_t last) {
    const std::uint32_t* const all = lists_.neighbours.data();
    const std::size_t begin = first == 0 ? 0 : lists_.ends[first - 1];
    const std::size_t shift = next_.neighbours.size() - begin;
    next_.neighbours.insert(next_.neighbours.end(), all + begin, all + lists_.ends[last]);
    for (std::uint32_t k = first; k <= last; ++k) next_.ends.push_back(lists_.ends[k] + shift);
}

/// Writes a new list in place of a cell's old one.
void KeptLists::write(std::uint32_t cell, std::span<const std::uint32_t> neighbours) {
    next_.far_links += far_links(cell, neighbours);
    next_.far_links -= far_links(cell, list_of(cell));
    next_.neighbours.insert(next_.neighbours.end(), neighbours.begin(), neighbours.end());
    next_.ends.push_back(next_.neighbours.size());
}

}  // namespace cascade
