// Boxes that are adjacent along x are adjacent in memory, so the cells of three such boxes are one
// range.
#include "tissue/cell_boxes.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace cascade {
namespace {

/// Below this number of cells, all pairs are compared. Comparing has no branches, so it takes less
/// time than sorting.
constexpr std::size_t most_compared = 48;

}  // namespace

std::span<const std::uint32_t> NeighbourKeys::sorted() {
    sorted_.resize(std::max(sorted_.size(), count_));
    if (count_ > most_compared) {
        std::vector<std::pair<std::int32_t, std::uint32_t>> pairs;
        for (std::size_t k = 0; k < count_; ++k) pairs.emplace_back(ranks_[k], cells_[k]);
        std::sort(pairs.begin(), pairs.end());
        for (std::size_t k = 0; k < count_; ++k) sorted_[k] = pairs[k].second;
        return {sorted_.data(), count_};
    }
    const std::int32_t* const ranks = ranks_.data();
    for (std::size_t k = 0; k < count_; ++k) {
        const std::int32_t own = ranks[k];
        std::int32_t before = 0;
        for (std::size_t other = 0; other < count_; ++other) before += ranks[other] < own ? 1 : 0;
        sorted_[static_cast<std::size_t>(before)] = cells_[k];
    }
    return {sorted_.data(), count_};
}

CellBoxes::CellBoxes(const std::vector<BoxedCell>& cells, const NeighbourRule& rule) : rule_(rule) {
    double widest = 0;
    Vector3d low = cells[0].place, high = low;
    for (const BoxedCell& cell : cells) {
        widest = std::max(widest, width_of(cell, rule));
        const Vector3d& p = cell.place;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // Boxes are slightly wider than the widest distance, because box numbers are rounded.
    lay_out({low.x, low.y, low.z}, {high.x, high.y, high.z}, 2 * widest * (1 + 1e-9), cells.size());
    fill(cells);
}

/// Compares all candidates without branches, because no processor could predict the branches.
template <bool is_periodic>
void CellBoxes::look(const BoxedCell& own, std::int64_t first, std::int64_t last,
                     NeighbourKeys& found) const {
    const BoxedCell* at = cells_.data() + starts_[static_cast<std::size_t>(first)];
    const BoxedCell* const end = cells_.data() + starts_[static_cast<std::size_t>(last)];
    const NeighbourKeys::Room room = found.room_for(static_cast<std::size_t>(end - at));
    std::size_t next = 0;
    for (; at != end; ++at) {
        room.cells[next] = at->cell;
        room.ranks[next] = static_cast<std::int32_t>(at->rank);
        next += static_cast<unsigned>(are_near<is_periodic>(own, *at, rule_)) &
                static_cast<unsigned>(at->cell != own.cell);
    }
    found.add(next);
}

template <bool is_periodic>
void CellBoxes::find_as(const BoxedCell& own, NeighbourKeys& found) const {
    const std::array box = box_of(own.place);
    const auto look_at = [&](std::int64_t first, std::int64_t last) {
        look<is_periodic>(own, first, last, found);
    };
    axes_[2].visit_near(box[2], [&](std::int64_t z) {
        axes_[1].visit_near(box[1], [&](std::int64_t y) {
            const std::int64_t row = (z * axes_[1].count + y) * axes_[0].count;
            if (axes_[0].count < 3) {
                look_at(row, row + axes_[0].count);
            } else if (box[0] > 0 && box[0] + 1 < axes_[0].count) {
                look_at(row + box[0] - 1, row + box[0] + 2);
            } else {
                axes_[0].visit_near(box[0], [&](std::int64_t x) { look_at(row + x, row + x + 1); });
            }
        });
    });
}

void CellBoxes::find(const BoxedCell& own, NeighbourKeys& found) const {
    if (repeats(rule_)) {
        find_as<true>(own, found);
    } else {
        find_as<false>(own, found);
    }
}

void CellBoxes::lay_out(std::array<double, 3> low, std::array<double, 3> high, double side,
                        std::size_t cells) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double period = rule_.period[k], size = period > 0 ? period : high[k] - low[k];
        const double boxes = side > 0 ? std::floor(size / side) + (period > 0 ? 0 : 1) : 1;
        axes_[k].low = low[k];
        axes_[k].count = static_cast<std::int64_t>(std::clamp(boxes, 1.0, 1e6));
    }
    const auto total = [&] { return axes_[0].count * axes_[1].count * axes_[2].count; };
    while (total() > static_cast<std::int64_t>(4 * cells + 64)) {
        BoxAxis& longest =
            *std::max_element(axes_.begin(), axes_.end(),
                              [](const BoxAxis& a, const BoxAxis& b) { return a.count < b.count; });
        longest.count = (longest.count + 1) / 2;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double period = rule_.period[k];
        const double own = period > 0 ? period / static_cast<double>(axes_[k].count) : side;
        axes_[k].inverse_side = own > 0 ? 1 / own : 0;
    }
}

/// Counting sort by box.
void CellBoxes::fill(const std::vector<BoxedCell>& cells) {
    std::vector<std::uint32_t> slots;
    slots.reserve(cells.size());
    starts_.assign(static_cast<std::size_t>(axes_[0].count * axes_[1].count * axes_[2].count) + 1,
                   0);
    for (const BoxedCell& cell : cells) {
        const std::array box = box_of(cell.place);
        slots.push_back(static_cast<std::uint32_t>(
            (box[2] * axes_[1].count + box[1]) * axes_[0].count + box[0]));
        ++starts_[slots.back() + 1];
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    cells_.resize(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) cells_[next[slots[k]]++] = cells[k];
}

}  // namespace cascade
