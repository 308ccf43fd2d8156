// Stretches are symmetric 2 × 2 matrices in the frame of their triangle.
#include "surface/anisotropy.h"

#include <algorithm>

namespace cascade {

Stretch Stretch::along(Vector2d direction, double ratio) {
    const double size = length(direction);
    if (!(size > 0) || !(ratio > 1)) return {};
    const double c = direction.x / size, s = direction.y / size;
    const double root = std::sqrt(ratio);
    return {c * c / root + s * s * root, c * s * (1 / root - root), s * s / root + c * c * root};
}

double Stretch::longest() const {
    // A stretch and its inverse have the same eigenvalues, whose product is 1.
    const double half_sum = std::max((xx + yy) / 2, 1.0);
    return half_sum + std::sqrt(half_sum * half_sum - 1);
}

Stretch Stretch::in_frame(Vector2d turn) const {
    const Vector2d x = turned_into((*this)(turn), turn);
    const Vector2d y = turned_into((*this)({-turn.y, turn.x}), turn);
    return {x.x, x.y, y.y};
}

Stretch Anisotropy::of(const SurfaceMesh& mesh, std::uint32_t triangle) const {
    const Vector3d base = unit(mesh.corner(triangle, 1) - mesh.corner(triangle, 0));
    const Vector3d side = cross(unit(mesh.double_area_normal(triangle)), base);
    const Vector3d towards = unit(direction[triangle]);
    const Vector2d flat = {dot(towards, base), dot(towards, side)};
    if (length(flat) < 1e-6) return {};
    return Stretch::along(flat, ratio_of(triangle));
}

double Anisotropy::ratio_of(std::uint32_t triangle) const {
    const double written = ratio[triangle];
    return written > 1 ? std::min(written, largest_ratio) : 1;
}

}  // namespace cascade
