// Each cell searches for neighbours in its octave and in octaves of larger cells. Then each pair of
// different octaves is added to the list of its larger cell.
#include "tissue/neighbours.h"

#include "core/morton.h"
#include "tissue/neighbour_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace cascade {
namespace {

/// Two neighbours of different octaves.
struct Pair {
    std::uint32_t larger = 0, smaller = 0;
};

/// The lists of one thread's cells.
struct Part {
    std::vector<std::size_t> counts;
    std::vector<std::uint32_t> neighbours;
    /// Neighbours in different octaves, found by the smaller cell. The list of the larger cell does
    /// not contain the smaller cell yet.
    std::vector<Pair> pairs;
    std::size_t far_links = 0;
};

void search_part(const NeighbourSearch& search, RowRange cells, std::atomic<std::int64_t>& left,
                 Part& part) {
    // The number of cells that a thread searches before it checks again how many links are still
    // allowed.
    constexpr std::int64_t cells_at_once = 256;
    part.neighbours.reserve(static_cast<std::size_t>(16 * (cells.end - cells.begin)));
    part.counts.reserve(static_cast<std::size_t>(cells.end - cells.begin));
    NeighbourKeys found;
    std::int64_t links = 0;
    for (std::int64_t k = cells.begin; k < cells.end; ++k) {
        if (k % cells_at_once == 0 || links > cells_at_once * 64) {
            if (left.fetch_sub(links, std::memory_order_relaxed) < links) return;
            links = 0;
        }
        const auto cell = static_cast<std::uint32_t>(k);
        const std::size_t larger = search.find(cell, found);
        for (const std::uint32_t other : found.cells().first(larger)) {
            part.pairs.push_back({other, cell});
        }
        const std::span<const std::uint32_t> sorted = found.sorted();
        part.neighbours.insert(part.neighbours.end(), sorted.begin(), sorted.end());
        for (const std::uint32_t other : sorted) {
            part.far_links += is_far_link(cell, other) ? 1 : 0;
        }
        part.counts.push_back(sorted.size());
        links += static_cast<std::int64_t>(sorted.size() + larger);
    }
    left.fetch_sub(links, std::memory_order_relaxed);
}

/// Adds the smaller cell of each pair to the list of the larger cell.
void add_pairs(std::span<const Pair> pairs, std::span<const std::uint32_t> ranks,
               NeighbourLists& lists) {
    std::vector<std::size_t> ends(lists.ends.size(), 0);
    for (const Pair& pair : pairs) ++ends[pair.larger];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<std::uint32_t> smaller(pairs.size());
    for (std::size_t k = pairs.size(); k-- > 0;)
        smaller[--ends[pairs[k].larger]] = pairs[k].smaller;
    NeighbourLists whole;
    whole.far_links = lists.far_links;
    whole.neighbours.reserve(lists.neighbours.size() + pairs.size());
    NeighbourKeys keys;
    for (std::size_t cell = 0; cell < lists.ends.size(); ++cell) {
        const std::size_t last = cell + 1 < ends.size() ? ends[cell + 1] : smaller.size();
        keys.clear();
        for (std::size_t k = cell == 0 ? 0 : lists.ends[cell - 1]; k < lists.ends[cell]; ++k) {
            keys.add(lists.neighbours[k], ranks[lists.neighbours[k]]);
        }
        for (std::size_t k = ends[cell]; k < last; ++k) {
            keys.add(smaller[k], ranks[smaller[k]]);
        }
        const std::span<const std::uint32_t> sorted = keys.sorted();
        whole.neighbours.insert(whole.neighbours.end(), sorted.begin(), sorted.end());
        whole.ends.push_back(whole.neighbours.size());
    }
    lists = std::move(whole);
}

tl::unexpected<Failure> too_many(std::size_t cells, double links, double most_links) {
    return failure(
        fmt::format("{} cells would have about {:.0f} neighbours each: {:.2g} pairs of cells, "
                    "but there is memory only for {:.2g}",
                    cells, links / static_cast<double>(cells), links, most_links),
        "use smaller radii or a smaller distance in near(…)");
}

}  // namespace

Result<NeighbourLists> find_neighbours(const CellPlaces& cells, const NeighbourRule& rule,
                                       double skin, double most_links, Team& team) {
    return find_neighbours(NeighbourSearch(cells, rule, skin), cells.ranks, most_links, team);
}

Result<NeighbourLists> find_neighbours(const NeighbourSearch& search,
                                       std::span<const std::uint32_t> ranks, double most_links,
                                       Team& team) {
    NeighbourLists lists;
    if (search.finds_nothing()) {
        lists.ends.assign(search.count(), 0);
        return lists;
    }
    const double estimate = search.estimated_links();
    if (estimate > most_links) return too_many(search.count(), estimate, most_links);
    std::atomic<std::int64_t> left = static_cast<std::int64_t>(std::min(most_links, 1e18));
    std::vector<Part> parts(static_cast<std::size_t>(team.size()));
    team.run([&](int thread) {
        const auto count = static_cast<std::int64_t>(search.count());
        search_part(search, split_rows(count, thread, team.size()), left,
                    parts[static_cast<std::size_t>(thread)]);
    });
    if (left < 0) return too_many(search.count(), std::max(estimate, most_links), most_links);
    std::vector<Pair> pairs;
    lists.ends.reserve(search.count());
    std::size_t end = 0;
    for (Part& part : parts) {
        for (const std::size_t count : part.counts) lists.ends.push_back(end += count);
        if (lists.neighbours.empty()) {
            lists.neighbours = std::move(part.neighbours);
        } else {
            lists.neighbours.insert(lists.neighbours.end(), part.neighbours.begin(),
                                    part.neighbours.end());
        }
        pairs.insert(pairs.end(), part.pairs.begin(), part.pairs.end());
        lists.far_links += part.far_links;
    }
    if (!pairs.empty()) add_pairs(pairs, ranks, lists);
    return lists;
}

std::vector<std::uint32_t> order_along_curve(const CellPlaces& cells) {
    std::vector<std::uint32_t> order(cells.places.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    if (order.empty()) return order;
    Vector3d low = cells.places[0], high = low;
    for (const Vector3d& p : cells.places) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    // The number of boxes along the longest side. If this number is n, cells on a surface fill
    // about n² of n³ boxes.
    const double boxes = std::min(2097151.0, 2 * std::sqrt(static_cast<double>(order.size())));
    const double scale = size > 0 ? boxes / size : 0;
    std::vector<std::uint64_t> places;
    places.reserve(order.size());
    for (const Vector3d& p : cells.places) {
        const Vector3d at = (p - low) * scale;
        places.push_back(morton_place(static_cast<std::uint64_t>(at.x),
                                      static_cast<std::uint64_t>(at.y),
                                      static_cast<std::uint64_t>(at.z)));
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return places[a] != places[b] ? places[a] < places[b] : cells.ranks[a] < cells.ranks[b];
    });
    return order;
}

}  // namespace cascade
