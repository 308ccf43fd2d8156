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

/// A cell as a search sees it.
struct BoxedCell {
    Vector3d place;
    double reach = 0, slack = 0;  ///< Its part of the distance at which cells are neighbours.
    std::uint32_t cell = 0, rank = 0;
};

/// A neighbour as a word that sorts by number.
inline std::uint64_t neighbour_key(std::uint32_t rank, std::uint32_t cell) {
    return std::uint64_t{rank} << 32 | cell;
}

/// The neighbours found for a cell.
class NeighbourKeys {
public:
    /// The address after the last key, with room for some more.
    std::uint64_t* room_for(std::size_t more) {
        if (count_ + more > keys_.size()) keys_.resize(2 * (count_ + more));
        return keys_.data() + count_;
    }
    void end_at(const std::uint64_t* end) { count_ = static_cast<std::size_t>(end - keys_.data()); }
    void clear() { count_ = 0; }
    void add(std::uint64_t key) { *room_for(1) = key, ++count_; }
    std::span<const std::uint64_t> all() const { return {keys_.data(), count_}; }
    std::size_t count() const { return count_; }

    /// Most lists are short.
    void sort() {
        if (count_ > 32) return std::sort(keys_.begin(), keys_.begin() + count_);
        for (std::size_t k = 1; k < count_; ++k) {
            const std::uint64_t key = keys_[k];
            std::size_t at = k;
            for (; at > 0 && keys_[at - 1] > key; --at) keys_[at] = keys_[at - 1];
            keys_[at] = key;
        }
    }

private:
    std::vector<std::uint64_t> keys_;
    std::size_t count_ = 0;
};

/// A box's number along an axis, which repeats after `count` boxes. Where the tissue itself does
/// not repeat, boxes that share a number are far apart, and distances tell their cells apart.
struct BoxAxis {
    double low = 0, inverse_side = 0;
    std::int64_t count = 1;

    std::int64_t box_of(double at) const {
        constexpr double farthest = 4503599627370496.0;  // 2^52
        const double box = std::clamp(std::floor((at - low) * inverse_side), -farthest, farthest);
        const auto number = static_cast<std::int64_t>(box) % count;
        return number < 0 ? number + count : number;
    }
    /// Calls `visit` with the different numbers among box − 1, box and box + 1.
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

/// Cells of similar radii in boxes that are as wide as the distance of neighbours.
class CellBoxes {
public:
    /// There must be a cell.
    CellBoxes(const std::vector<BoxedCell>& cells, const NeighbourRule& rule);

    /// Adds the keys of all neighbours of a cell among these.
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
    std::vector<std::uint32_t> starts_;  ///< Of each box in `cells_`, and one more.
    std::vector<BoxedCell> cells_;
};

}  // namespace cascade
