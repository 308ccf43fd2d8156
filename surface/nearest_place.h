// The place on a surface that is nearest to a point in space.
#pragma once

#include "mesh/flat.h"

#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The triangles of a mesh in a tree of boxes, each halved along its longest side at the middle one
/// of its triangles. A search visits few of them: O(log n) where the point is near the surface. Of
/// places that are equally near the one on the triangle of the lowest number is found. The mesh
/// must stay as it is while this is used; any number of threads may search at once.
class NearestPlace {
public:
    explicit NearestPlace(const SurfaceMesh& mesh);

    /// Nothing if the mesh has no triangles or the point is not finite.
    std::optional<SurfacePlace> find(Vector3d point) const;

private:
    struct Box {
        Vector3d low, high;
        std::uint32_t first = 0, count = 0;  ///< Of `order_`; count 0 where it has two parts.
        std::uint32_t part = 0;              ///< The first part; the second one follows it.
    };
    struct Best;
    void split(std::uint32_t box, std::span<const Vector3d> middles);
    void fit(Box& box) const;
    void search(const Box& box, Vector3d point, Best& best) const;

    const SurfaceMesh& mesh_;
    std::vector<std::uint32_t> order_;  ///< Triangles, those of a box together.
    std::vector<Box> boxes_;            ///< The first holds everything.
};

/// The point of a triangle nearest to a point, as weights of its corners.
std::array<double, 3> nearest_weights(const std::array<Vector3d, 3>& corners, Vector3d point);

}  // namespace cascade
