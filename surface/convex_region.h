// Convex regions of a plane. Each edge has a label: the region beyond the edge.
#pragma once

#include "mesh/flat.h"

#include <cstdint>
#include <vector>

namespace cascade {

class ConvexRegion {
public:
    static constexpr std::uint32_t nothing = 0xffffffff;
    struct Edge {
        /// The start of the edge. The edge ends where the next edge starts, counterclockwise.
        Vector2d from;
        std::uint32_t beyond = nothing;
    };

    /// The square −half … half along both axes.
    static ConvexRegion square(double half);

    const std::vector<Edge>& edges() const { return edges_; }
    bool empty() const { return edges_.empty(); }
    void clear() { edges_.clear(); }
    double area() const;
    /// The mean of the corners; the origin if the region is empty.
    Vector2d middle() const;
    /// The distance of the farthest corner from the origin.
    double farthest() const;

    /// Keeps the part to the left of the line from a to b. The new edge gets the label `beyond`.
    void cut(Vector2d a, Vector2d b, std::uint32_t beyond);
    /// Keeps the part nearer to the origin than to `point`.
    void cut_halfway(Vector2d point, std::uint32_t beyond) {
        const Vector2d middle = point * 0.5;
        cut(middle, middle + Vector2d{-point.y, point.x}, beyond);
    }

private:
    std::vector<Edge> edges_;
    std::vector<Edge> scratch_;
};

}  // namespace cascade
