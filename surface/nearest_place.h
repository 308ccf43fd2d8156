// Finds the nearest position on a surface to a point in space.
#pragma once

#include "mesh/flat.h"

#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The triangles of a mesh in a tree of bounding boxes, each split along its longest side at the
/// median triangle. A search takes O(log n) steps if the point is near the surface. If several
/// positions are equally near, a search finds the position on the triangle with the lowest index.
/// The mesh must outlive the tree unchanged. Searches are thread-safe.
class NearestPlace {
public:
    explicit NearestPlace(const SurfaceMesh& mesh);

    /// The nearest position; nullopt if the mesh has no triangles or the point is not finite.
    std::optional<SurfacePlace> find(Vector3d point) const;

private:
    struct Box {
        Vector3d low, high;
        /// The triangles of the box, as a range of `order_`. `count` is 0 if the box is divided
        /// into two parts.
        std::uint32_t first = 0, count = 0;
        std::uint32_t part = 0;  ///< The index of the first part. The second part follows it.
    };
    struct Best;
    void split(std::uint32_t box, std::span<const Vector3d> middles);
    void fit(Box& box) const;
    void search(const Box& box, Vector3d point, Best& best) const;

    const SurfaceMesh& mesh_;
    std::vector<std::uint32_t> order_;  ///< Triangles, grouped by box.
    std::vector<Box> boxes_;            ///< The first is the root.
};

/// The point of a triangle that is nearest to `point`, as weights of the triangle's corners.
std::array<double, 3> nearest_weights(const std::array<Vector3d, 3>& corners, Vector3d point);

}  // namespace cascade
