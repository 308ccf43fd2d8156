// A hash table whose slots represent boxes. Points are sorted by slot.
#include "surface/point_index.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cascade {

namespace {

// Box coordinates are clamped to this range, so points farther away share the outermost boxes.
constexpr double farthest_box = 1 << 30;

std::int32_t number_of(double place) {
    return static_cast<std::int32_t>(std::floor(std::clamp(place, -farthest_box, farthest_box)));
}

}  // namespace

PointIndex::Box PointIndex::box_of(Vector3d p) const {
    const Vector3d q = (p - low_) * (1 / reach_);
    return {number_of(q.x), number_of(q.y), number_of(q.z)};
}

PointIndex::PointIndex(std::span<const Vector3d> points, double reach) : reach_(reach) {
    if (!points.empty()) low_ = points[0];
    for (const Vector3d& p : points) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    }
    // At least four, because the four boxes of a block along x have adjacent slots.
    const std::size_t slots = std::bit_ceil(2 * points.size() + 3);
    mask_ = slots - 1;
    starts_.assign(slots + 1, 0);
    std::vector<Box> boxes;
    boxes.reserve(points.size());
    for (const Vector3d& p : points) {
        boxes.push_back(box_of(p));
        ++starts_[slot_of(boxes.back()) + 1];
    }
    for (std::size_t slot = 0; slot < slots; ++slot) starts_[slot + 1] += starts_[slot];
    entries_.resize(points.size());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        entries_[next[slot_of(boxes[k])]++] = {boxes[k], k, points[k]};
    }
}

}  // namespace cascade
