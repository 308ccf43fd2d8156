// Finding the points near a point, by boxes of one size.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Points sorted by the box of side `reach` in which they lie.
class PointIndex {
public:
    /// `reach` is above 0. The points must stay where they are as long as the index is used.
    PointIndex(std::span<const Vector3d> points, double reach);

    /// Calls `visit(number)` for all points no farther than `reach` from `centre`, itself included,
    /// in an order that depends on the points only.
    template <typename Visit>
    void near(Vector3d centre, const Visit& visit) const {
        const Box middle = box_of(centre);
        for (std::int32_t dz = -1; dz <= 1; ++dz) {
            for (std::int32_t dy = -1; dy <= 1; ++dy) {
                for (std::int32_t dx = -1; dx <= 1; ++dx) {
                    const Box box = {middle[0] + dx, middle[1] + dy, middle[2] + dz};
                    const std::size_t slot = slot_of(box);
                    for (std::uint32_t k = starts_[slot]; k < starts_[slot + 1]; ++k) {
                        const Entry& entry = entries_[k];
                        if (entry.box != box) continue;
                        const Vector3d apart = entry.point - centre;
                        if (dot(apart, apart) <= reach_ * reach_) visit(entry.number);
                    }
                }
            }
        }
    }

private:
    using Box = std::array<std::int32_t, 3>;
    struct Entry {
        Box box{};
        std::uint32_t number = 0;
        Vector3d point;
    };
    Box box_of(Vector3d p) const;
    std::size_t slot_of(const Box& box) const {
        std::uint32_t hash = static_cast<std::uint32_t>(box[0]) * 0x9e3779b1u;
        hash = (hash ^ static_cast<std::uint32_t>(box[1])) * 0x85ebca77u;
        hash = (hash ^ (hash >> 15) ^ static_cast<std::uint32_t>(box[2])) * 0xc2b2ae3du;
        return (hash ^ (hash >> 16)) & mask_;
    }

    Vector3d low_;
    double reach_;
    std::size_t mask_ = 0;
    std::vector<std::uint32_t> starts_;  ///< Of each slot in `entries_`, and one more.
    std::vector<Entry> entries_;
};

}  // namespace cascade
