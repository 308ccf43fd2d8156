// Cells in boxes, for the search for neighbours (internal to tissue/).
#pragma once

#include "tissue/neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The data about a cell that a search needs.
struct BoxedCell {
    Vector3d place;
    /// Two cells are neighbours if their distance is less than the larger of NeighbourRule::near
    /// and the sum of both cells' `reach`, plus the sum of both cells' `slack`.
    double reach = 0, slack = 0;
    std::uint32_t cell = 0, rank = 0;
};

/// The search data of a cell whose list has the skin `skin`.
inline BoxedCell boxed(const CellPlaces& cells, std::uint32_t cell, const NeighbourRule& rule,
                       double skin) {
    const double radius = cells.radii[cell];
    return {cells.places[cell], rule.reach * radius, slack_of(rule, skin, radius), cell,
            cells.ranks[cell]};
}
/// Half the distance at which two cells are neighbours if both are like this cell.
inline double width_of(const BoxedCell& cell, const NeighbourRule& rule) {
    return std::max(cell.reach, rule.near / 2) + cell.slack;
}
/// The difference along an axis between a cell and the nearest periodic image of another cell.
inline double nearest_image(double difference, double period) {
    return period > 0 ? difference - period * std::nearbyint(difference / period) : difference;
}
/// Whether two cells are neighbours. The result is the same if the two are exchanged.
template <bool is_periodic>
bool are_near(const BoxedCell& own, const BoxedCell& other, const NeighbourRule& rule) {
    Vector3d apart = other.place - own.place;
    if constexpr (is_periodic) {
        apart = {nearest_image(apart.x, rule.period[0]), nearest_image(apart.y, rule.period[1]),
                 nearest_image(apart.z, rule.period[2])};
    }
    const double distance =
        std::max(own.reach + other.reach, rule.near) + (own.slack + other.slack);
    return dot(apart, apart) < distance * distance;
}
inline bool repeats(const NeighbourRule& rule) { return rule.period != std::array<double, 3>{}; }

/// The neighbours found for a cell.
class NeighbourKeys {
public:
    /// Memory for the cells that are found next and for their ranks. It has a little more room than
    /// needed.
    struct Room {
        std::uint32_t* cells;
        std::int32_t* ranks;
    };
    Room room_for(std::size_t more) {
        if (count_ + more > cells_.size()) {
            cells_.resize(2 * (count_ + more));
            ranks_.resize(cells_.size());
        }
        return {cells_.data() + count_, ranks_.data() + count_};
    }
    void add(std::size_t more) { count_ += more; }
    void add(std::uint32_t cell, std::uint32_t rank) {
        const Room room = room_for(1);
        *room.cells = cell;
        *room.ranks = static_cast<std::int32_t>(rank);
        ++count_;
    }
    void clear() { count_ = 0; }
    /// Removes the cells for which `is_out` is true.
    void leave_out(const auto& is_out) {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < count_; ++k) {
            if (is_out(cells_[k])) continue;
            cells_[kept] = cells_[k];
            ranks_[kept++] = ranks_[k];
        }
        count_ = kept;
    }
    /// Updates the cells' ranks.
    void rank(std::span<const std::uint32_t> ranks) {
        for (std::size_t k = 0; k < count_; ++k) {
            ranks_[k] = static_cast<std::int32_t>(ranks[cells_[k]]);
        }
    }
    std::span<const std::uint32_t> cells() const { return {cells_.data(), count_}; }
    std::size_t count() const { return count_; }

    /// The cells in ascending order of their ranks, valid until the next change.
    std::span<const std::uint32_t> sorted();

private:
    std::vector<std::uint32_t> cells_, sorted_;
    std::vector<std::int32_t> ranks_;
    std::size_t count_ = 0;
};

/// The numbers of boxes along an axis, which repeat after `count` boxes. If the tissue is not
/// periodic, boxes with the same number are far apart. Their cells are excluded later because of
/// their distance.
struct BoxAxis {
    double low = 0, inverse_side = 0;
    std::int64_t count = 1;

    std::int64_t box_of(double at) const {
        constexpr double farthest = 4503599627370496.0;  // 2^52
        const double box = std::clamp(std::floor((at - low) * inverse_side), -farthest, farthest);
        const auto number = static_cast<std::int64_t>(box) % count;
        return number < 0 ? number + count : number;
    }
    /// Calls `visit` with the numbers of the boxes before, at and after `box`. Calls it only once
    /// for numbers that are equal.
    void visit_near(std::int64_t box, const auto& visit) const {
        if (count < 3) {
            for (std::int64_t k = 0; k < count; ++k) visit(k);
            return;
        }
        visit(box == 0 ? count - 1 : box - 1);
        visit(box);
        visit(box + 1 == count ? 0 : box + 1);
    }
};

/// Cells of similar radii, in boxes as wide as the distance of neighbours.
class CellBoxes {
public:
    /// `cells` must not be empty.
    CellBoxes(const std::vector<BoxedCell>& cells, const NeighbourRule& rule);

    /// Adds all neighbours of a cell in these boxes to `found`.
    void find(const BoxedCell& own, NeighbourKeys& found) const;

private:
    template <bool is_periodic>
    void find_as(const BoxedCell& own, NeighbourKeys& found) const;
    template <bool is_periodic>
    void look(const BoxedCell& own, std::int64_t first, std::int64_t last,
              NeighbourKeys& found) const;
    void lay_out(std::array<double, 3> low, std::array<double, 3> high, double side,
                 std::size_t cells);
    void fill(const std::vector<BoxedCell>& cells);
    std::array<std::int64_t, 3> box_of(const Vector3d& p) const {
        return {axes_[0].box_of(p.x), axes_[1].box_of(p.y), axes_[2].box_of(p.z)};
    }

    NeighbourRule rule_;
    std::array<BoxAxis, 3> axes_;
    /// The index at which each box starts in `cells_`, and the end of the last box.
    std::vector<std::uint32_t> starts_;
    std::vector<BoxedCell> cells_;
};

}  // namespace cascade
