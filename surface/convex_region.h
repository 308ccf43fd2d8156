// Convex regions of a plane whose edges know what lies beyond them.
#pragma once

#include "mesh/flat.h"

#include <cstdint>
#include <vector>

namespace cascade {

class ConvexRegion {
public:
    static constexpr std::uint32_t nothing = 0xffffffff;
    struct Edge {
        Vector2d from;  ///< It ends where the next one begins, counterclockwise.
        std::uint32_t beyond = nothing;
    };

    /// The square −half … half along both axes.
    static ConvexRegion square(double half);

    const std::vector<Edge>& edges() const { return edges_; }
    bool empty() const { return edges_.empty(); }
    void clear() { edges_.clear(); }
    double area() const;
    /// The mean of the corners; of none the origin.
    Vector2d middle() const;
    /// Of the corner farthest from the origin.
    double farthest() const;

    /// Keeps what lies to the left of the line from a to b; a new edge along it has `beyond`
    /// beyond.
    void cut(Vector2d a, Vector2d b, std::uint32_t beyond);
    /// Keeps what is nearer to the origin than to a point.
    void cut_halfway(Vector2d point, std::uint32_t beyond) {
        const Vector2d middle = point * 0.5;
        cut(middle, middle + Vector2d{-point.y, point.x}, beyond);
    }

private:
    std::vector<Edge> edges_;
    std::vector<Edge> scratch_;
};

}  // namespace cascade
