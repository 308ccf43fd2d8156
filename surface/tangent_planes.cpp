// The turn of a link is the difference of the angles of the edge in the two planes.
#include "surface/tangent_planes.h"

#include <cmath>
#include <numbers>

namespace cascade {

namespace {

/// The direction of an edge in the frame of its triangle.
double edge_angle(const SurfaceMesh& mesh, TriangleEdge edge) {
    const FlatTriangle flat = own_frame(mesh, edge.triangle);
    const Vector2d along = flat[corner_after(edge.edge)] - flat[edge.edge];
    return std::atan2(along.y, along.x);
}

TangentLink link_over(const SurfaceMesh& mesh, TriangleEdge here, TriangleEdge there) {
    const Vector3d from = mesh.corner(here.triangle, here.edge);
    const Vector3d along = mesh.corner(here.triangle, corner_after(here.edge)) - from;
    const Vector3d half_way = from + along * 0.5;
    TangentLink link;
    link.neighbour = there.triangle;
    // The other triangle has the edge in the opposite direction. The triangle with the lower index
    // is the reference, so that the two sides are exact negatives.
    const double out = edge_angle(mesh, here), back = edge_angle(mesh, there);
    constexpr double half_turn = std::numbers::pi;
    link.turn = here.triangle < there.triangle ? out - back - half_turn : -(back - out - half_turn);
    link.distance = length(mesh.centroid(here.triangle) - half_way) +
                    length(half_way - mesh.centroid(there.triangle));
    // The centroids are a third of the triangles' heights away from the edge.
    const double areas = mesh.area(here.triangle) + mesh.area(there.triangle);
    const double weight = 1.5 * dot(along, along) / areas;
    link.weight = std::isfinite(weight) ? weight : 0;
    return link;
}

}  // namespace

TangentPlanes planes_of_triangles(const SurfaceMesh& mesh) {
    TangentPlanes planes;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        planes.places.push_back({t, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        planes.frames.push_back(tangent_frame(mesh, t));
        planes.areas.push_back(mesh.area(t));
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            if (other.exists()) planes.links.push_back(link_over(mesh, {t, k}, other));
        }
        planes.ends.push_back(planes.links.size());
    }
    return planes;
}

}  // namespace cascade
