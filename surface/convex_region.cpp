// Cuts by one half-plane at a time (Sutherland and Hodgman) and labels each edge.
#include "surface/convex_region.h"

#include <algorithm>

namespace cascade {

ConvexRegion ConvexRegion::square(double half) {
    ConvexRegion region;
    for (const Vector2d corner : {Vector2d{-half, -half}, Vector2d{half, -half},
                                  Vector2d{half, half}, Vector2d{-half, half}}) {
        region.edges_.push_back({corner, nothing});
    }
    return region;
}

double ConvexRegion::area() const {
    double twice = 0;
    for (std::size_t k = 1; k + 1 < edges_.size(); ++k) {
        twice += cross(edges_[k].from - edges_[0].from, edges_[k + 1].from - edges_[0].from);
    }
    return twice / 2;
}

Vector2d ConvexRegion::middle() const {
    Vector2d sum;
    for (const Edge& edge : edges_) sum = sum + edge.from;
    return edges_.empty() ? sum : sum * (1 / static_cast<double>(edges_.size()));
}

double ConvexRegion::farthest() const {
    double square = 0;
    for (const Edge& edge : edges_) square = std::max(square, dot(edge.from, edge.from));
    return std::sqrt(square);
}

void ConvexRegion::cut(Vector2d a, Vector2d b, std::uint32_t beyond) {
    const Vector2d along = b - a;
    const auto side = [&](Vector2d p) { return cross(along, p - a); };
    scratch_.clear();
    for (std::size_t k = 0; k < edges_.size(); ++k) {
        const Edge& edge = edges_[k];
        const Vector2d to = edges_[k + 1 == edges_.size() ? 0 : k + 1].from;
        const double here = side(edge.from), there = side(to);
        const auto meeting = [&] { return edge.from + (to - edge.from) * (here / (here - there)); };
        if (here >= 0) scratch_.push_back(edge);
        if (here >= 0 && there < 0) scratch_.push_back({meeting(), beyond});
        if (here < 0 && there > 0) scratch_.push_back({meeting(), edge.beyond});
    }
    if (scratch_.size() < 3) scratch_.clear();
    edges_.swap(scratch_);
}

}  // namespace cascade
