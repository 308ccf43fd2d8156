// Gram-Schmidt orthogonalisation of two edges of the triangle, which are normalised first.
#include "surface/tangent_frame.h"

namespace cascade {

namespace {

/// Any unit vector perpendicular to the unit vector v.
Vector3d any_normal_to(Vector3d v) {
    const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    const Vector3d least = x <= y && x <= z ? Vector3d{1, 0, 0}
                           : y <= z         ? Vector3d{0, 1, 0}
                                            : Vector3d{0, 0, 1};
    return unit(least - v * dot(least, v));
}

}  // namespace

TangentFrame tangent_frame(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const Vector3d a = mesh.corner(triangle, 0);
    // The edges are normalised first, so that their product does not underflow in tiny triangles.
    Vector3d along = unit(mesh.corner(triangle, 1) - a);
    const Vector3d side = unit(mesh.corner(triangle, 2) - a);
    if (length(along) == 0) along = length(side) > 0 ? side : Vector3d{1, 0, 0};
    Vector3d normal = unit(cross(along, side));
    // If edges are nearly parallel, rounding has tilted the cross product.
    normal = unit(normal - along * dot(normal, along));
    if (!(length(normal) > 0.5)) normal = any_normal_to(along);
    return {along, unit(cross(normal, along)), normal};
}

}  // namespace cascade
