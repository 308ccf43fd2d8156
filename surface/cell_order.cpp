// Orders cells by their breadth-first distance along links (Cuthill and McKee). Then sorts the
// cells of each window by their numbers of links.
#include "surface/cell_order.h"

#include "core/check.h"

#include <algorithm>
#include <numeric>

namespace cascade {
namespace {

std::size_t link_count(const LinkList& links, std::uint32_t cell) {
    return links.ends[cell] - (cell == 0 ? 0 : links.ends[cell - 1]);
}

/// Breadth-first search along links over the cells that have not been ordered yet.
class LevelWalk {
public:
    explicit LevelWalk(const LinkList& links)
        : links_(links), seen_(links.ends.size(), 0), is_ordered_(links.ends.size(), false) {}

    struct Reached {
        /// The cells level by level. A cell's neighbours are in ascending order of their numbers of
        /// links.
        std::vector<std::uint32_t> cells;
        std::size_t levels = 0;
        std::size_t last_level = 0;  ///< The index of the last level's first cell.
    };
    Reached from(std::uint32_t start) {
        ++round_;
        seen_[start] = round_;
        Reached reached{{start}, 0, 0};
        for (std::size_t place = 0; place < reached.cells.size();) {
            ++reached.levels;
            reached.last_level = place;
            for (const std::size_t end = reached.cells.size(); place < end; ++place) {
                add_neighbours(reached.cells[place], reached.cells);
            }
        }
        return reached;
    }

    /// The levels from a peripheral cell. Each trial starts from a cell of the previous trial's
    /// last level.
    Reached from_rim(std::uint32_t start) {
        constexpr int most_trials = 8;  // Two or three trials are usually enough.
        Reached best = from(start);
        for (int trial = 1; trial < most_trials; ++trial) {
            const auto rim = best.cells.begin() + static_cast<std::ptrdiff_t>(best.last_level);
            Reached other = from(*std::min_element(rim, best.cells.end(), [&](auto a, auto b) {
                return has_fewer_links(a, b);
            }));
            if (other.levels <= best.levels) break;
            best = std::move(other);
        }
        return best;
    }

    bool is_ordered(std::uint32_t cell) const { return is_ordered_[cell]; }
    void add_to(std::vector<std::uint32_t>& order, const Reached& reached) {
        for (const std::uint32_t cell : reached.cells) is_ordered_[cell] = true;
        order.insert(order.end(), reached.cells.begin(), reached.cells.end());
    }

private:
    bool has_fewer_links(std::uint32_t a, std::uint32_t b) const {
        return std::pair(link_count(links_, a), a) < std::pair(link_count(links_, b), b);
    }

    void add_neighbours(std::uint32_t cell, std::vector<std::uint32_t>& cells) {
        const auto added = static_cast<std::ptrdiff_t>(cells.size());
        for (std::size_t k = link_count(links_, cell); k > 0; --k) {
            const std::uint32_t neighbour = links_.neighbours[links_.ends[cell] - k];
            if (seen_[neighbour] == round_ || is_ordered_[neighbour]) continue;
            seen_[neighbour] = round_;
            cells.push_back(neighbour);
        }
        std::sort(cells.begin() + added, cells.end(),
                  [&](auto a, auto b) { return has_fewer_links(a, b); });
    }

    const LinkList& links_;
    std::vector<std::uint32_t> seen_;  ///< The number of the last search that visited each cell.
    std::vector<bool> is_ordered_;
    std::uint32_t round_ = 0;
};

}  // namespace

std::vector<std::uint32_t> order_by_levels(const LinkList& links) {
    std::vector<std::uint32_t> order;
    order.reserve(links.ends.size());
    LevelWalk walk(links);
    for (std::uint32_t cell = 0; cell < links.ends.size(); ++cell) {
        if (walk.is_ordered(cell)) continue;
        walk.add_to(order, walk.from_rim(cell));
        // If links are not symmetric, the peripheral cell may not reach this cell.
        if (!walk.is_ordered(cell)) walk.add_to(order, walk.from(cell));
    }
    return order;
}

std::vector<std::uint32_t> order_for_steps(const LinkList& links) {
    constexpr std::size_t window = 64;
    std::vector<std::uint32_t> order = order_by_levels(links);
    group_by_links(order, links, window);
    return order;
}

void group_by_links(std::vector<std::uint32_t>& order, const LinkList& links, std::size_t window) {
    CHECK(window > 0, "a window has cells");
    for (std::size_t first = 0; first < order.size(); first += window) {
        const std::size_t end = std::min(order.size(), first + window);
        std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first),
                         order.begin() + static_cast<std::ptrdiff_t>(end),
                         [&](std::uint32_t a, std::uint32_t b) {
                             return link_count(links, a) < link_count(links, b);
                         });
    }
}

LinkList renumbered(const LinkList& links, std::span<const std::uint32_t> order) {
    std::vector<std::uint32_t> numbers(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        numbers[order[k]] = static_cast<std::uint32_t>(k);
    LinkList result;
    result.ends.reserve(order.size());
    result.neighbours.reserve(links.neighbours.size());
    result.weights.reserve(links.weights.size());
    result.gradients.reserve(links.gradients.size());
    std::vector<std::size_t> of_cell;
    for (const std::uint32_t cell : order) {
        of_cell.resize(link_count(links, cell));
        std::iota(of_cell.begin(), of_cell.end(), links.ends[cell] - of_cell.size());
        std::stable_sort(of_cell.begin(), of_cell.end(), [&](std::size_t a, std::size_t b) {
            return numbers[links.neighbours[a]] < numbers[links.neighbours[b]];
        });
        for (const std::size_t link : of_cell) {
            result.neighbours.push_back(numbers[links.neighbours[link]]);
            result.weights.push_back(links.weights[link]);
            if (!links.gradients.empty()) result.gradients.push_back(links.gradients[link]);
        }
        result.ends.push_back(result.neighbours.size());
    }
    return result;
}

}  // namespace cascade
