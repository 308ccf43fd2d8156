// Neighbour search for points, by boxes of one size.
#pragma once

#include "core/vector3.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Points sorted by the boxes that contain them. Boxes have side `reach`.
class PointIndex {
public:
    /// `reach`, positive, is about the usual search radius. The points must outlive the index
    /// unchanged.
    PointIndex(std::span<const Vector3d> points, double reach);

    /// Calls `visit(number, square)` for all points whose distance from `centre` is at most
    /// `radius`, including a point at `centre`. `square` is the squared distance. The order depends
    /// only on the points. If `radius` is many times `reach`, many boxes are searched, but never
    /// more than there are points.
    template <typename Visit>
    void near(Vector3d centre, double radius, const Visit& visit) const {
        const auto look_at = [&](const Entry& entry) {
            const Vector3d apart = entry.point - centre;
            const double square = dot(apart, apart);
            if (square <= radius * radius) visit(entry.number, square);
        };
        const double side = 2 * std::ceil(radius / reach_) + 1;
        if (side * side * side > static_cast<double>(entries_.size()) + 27) {
            for (const Entry& entry : entries_) look_at(entry);
            return;
        }
        // The radius is enlarged slightly to allow for rounding in box_of().
        const double wide = radius + 1e-6 * reach_;
        const Box first = box_of(centre - Vector3d{wide, wide, wide});
        const Box last = box_of(centre + Vector3d{wide, wide, wide});
        for (std::int32_t z = first.z; z <= last.z; ++z) {
            for (std::int32_t y = first.y; y <= last.y; ++y) {
                for (std::int32_t x = first.x, end = 0; x <= last.x; x = end) {
                    // The slots of a block's boxes along x are adjacent.
                    end = std::min(last.x, x | 3) + 1;
                    const std::size_t slot = slot_of({x, y, z});
                    const std::uint32_t stop = starts_[slot + static_cast<std::size_t>(end - x)];
                    for (std::uint32_t k = starts_[slot]; k < stop; ++k) {
                        const Box& box = entries_[k].box;
                        if (((box.y ^ y) | (box.z ^ z)) != 0) continue;
                        if (box.x >= x && box.x < end) look_at(entries_[k]);
                    }
                }
            }
        }
    }

private:
    struct Box {
        std::int32_t x = 0, y = 0, z = 0;
    };
    struct Entry {
        Box box;
        std::uint32_t number = 0;
        Vector3d point;
    };
    Box box_of(Vector3d p) const;
    /// The slot of a box. Boxes of a block of 4 × 4 × 4 have adjacent slots, in order along x, so
    /// that a search reads few cache lines.
    std::size_t slot_of(const Box& box) const {
        std::uint32_t hash = static_cast<std::uint32_t>(box.x >> 2) * 0x9e3779b1u;
        hash = (hash ^ static_cast<std::uint32_t>(box.y >> 2)) * 0x85ebca77u;
        hash = (hash ^ (hash >> 15) ^ static_cast<std::uint32_t>(box.z >> 2)) * 0xc2b2ae3du;
        const auto within =
            static_cast<std::uint32_t>((box.z & 3) << 4 | (box.y & 3) << 2 | (box.x & 3));
        return ((hash ^ (hash >> 16)) << 6 | within) & mask_;
    }

    Vector3d low_;
    double reach_;
    std::size_t mask_ = 0;
    /// The start of each slot's points in `entries_`, and the end of the last.
    std::vector<std::uint32_t> starts_;
    std::vector<Entry> entries_;
};

}  // namespace cascade
