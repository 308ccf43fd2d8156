#include "surface/unfolding.h"

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

/// From the origin to the line between two points.
double distance_to(Vector2d a, Vector2d b) {
    const Vector2d along = b - a;
    const double square = dot(along, along);
    const double part = square > 0 ? std::clamp(-dot(a, along) / square, 0.0, 1.0) : 0;
    return length(a + along * part);
}

}  // namespace

void Unfolding::add(std::uint32_t triangle, const FlatTriangle& flat, std::uint32_t entered,
                    double radius) {
    pieces_.push_back({triangle, flat});
    marks_[triangle] = first_mark_ + static_cast<std::uint32_t>(pieces_.size());
    for (std::uint32_t k = 0; k < 3; ++k) {
        const TriangleEdge other = mesh_.across[triangle][k];
        if (k == entered || !other.exists() || flat_of(other.triangle)) continue;
        const Vector2d from = flat[(k + 1) % 3], to = flat[k];
        const double distance = distance_to(from, to);
        if (distance > radius) continue;
        fronts_.push_back({distance, other, from, to});
        std::push_heap(fronts_.begin(), fronts_.end());
    }
}

std::span<const Unfolding::Piece> Unfolding::around(const SurfacePlace& place, double radius) {
    first_mark_ += static_cast<std::uint32_t>(pieces_.size());
    if (first_mark_ > std::numeric_limits<std::uint32_t>::max() - marks_.size()) {
        std::fill(marks_.begin(), marks_.end(), 0);
        first_mark_ = 0;
    }
    pieces_.clear();
    fronts_.clear();
    FlatTriangle flat = own_frame(mesh_, place.triangle);
    const Vector2d origin = position_of(flat, place.weights);
    for (Vector2d& corner : flat) corner = corner - origin;
    add(place.triangle, flat, 3, radius);
    while (!fronts_.empty()) {
        std::pop_heap(fronts_.begin(), fronts_.end());
        const Front front = fronts_.back();
        fronts_.pop_back();
        if (flat_of(front.into.triangle)) continue;
        add(front.into.triangle, lay_flat(mesh_, front.into, front.from, front.to), front.into.edge,
            radius);
    }
    return pieces_;
}

}  // namespace cascade
