// Finds points with equal coordinates.
#pragma once

#include "core/vector3.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace cascade {

/// A hash table that maps coordinates to the numbers of points. The points themselves are stored
/// elsewhere. The table distinguishes −0 from 0, so callers replace −0 by 0. NaN equals nothing.
class PointTable {
public:
    explicit PointTable(const std::vector<Vector3d>& points) : points_(points), slots_(64, empty) {}

    /// The first added point at the same position as point `number`. If there is no such point,
    /// adds `number` and returns it.
    std::uint32_t find_or_add(std::uint32_t number) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        std::uint32_t& slot = slot_of(points_[number]);
        if (slot == empty) {
            slot = number;
            ++count_;
        }
        return slot;
    }

private:
    static constexpr std::uint32_t empty = 0xffffffff;

    static std::size_t hash_of(const Vector3d& p) {
        std::uint64_t hash = 0;
        for (const double x : {p.x, p.y, p.z}) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15;
            hash ^= hash >> 32;
        }
        return hash;
    }
    /// The slot of a position, or a free slot for it.
    std::uint32_t& slot_of(const Vector3d& p) {
        std::size_t at = hash_of(p) & (slots_.size() - 1);
        while (slots_[at] != empty && !(points_[slots_[at]] == p))
            at = (at + 1) & (slots_.size() - 1);
        return slots_[at];
    }
    void grow() {
        std::vector<std::uint32_t> before(2 * slots_.size(), empty);
        before.swap(slots_);
        for (const std::uint32_t number : before) {
            if (number != empty) slot_of(points_[number]) = number;
        }
    }

    const std::vector<Vector3d>& points_;
    std::vector<std::uint32_t> slots_;
    std::size_t count_ = 0;
};

}  // namespace cascade
