// Walks from triangle to triangle. Lays each triangle flat beside the previous one. Limits the
// number of crossings.
#include "mesh/flat.h"

#include <algorithm>

namespace cascade {

namespace {

/// The limit of crossings in a walk. Rounding could make a walk circle around a point forever.
constexpr int most_crossings = 100'000;

/// The edge rotated by 90° counterclockwise.
Vector2d left_of(Vector2d edge) { return {-edge.y, edge.x}; }

/// The first edge that `step` crosses, starting at `point`, and the fraction of the step before the
/// crossing.
struct EdgeCrossing {
    std::uint32_t edge = 3;
    double part = 1;
};

EdgeCrossing first_crossing(const FlatTriangle& flat, Vector2d point, Vector2d step,
                            std::uint32_t entered) {
    EdgeCrossing first;
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (k == entered) continue;
        const Vector2d edge = flat[corner_after(k)] - flat[k];
        const double before = std::max(0.0, cross(edge, point - flat[k]));
        const double behind = cross(edge, point + step - flat[k]);
        if (behind >= 0) continue;
        const double part = before / (before - behind);
        if (part < first.part || first.edge == 3) first = {k, part};
    }
    return first;
}

}  // namespace

FlatTriangle lay_flat(const SurfaceMesh& mesh, TriangleEdge edge, Vector2d from, Vector2d to) {
    const std::uint32_t k = edge.edge;
    const Vector3d start = mesh.corner(edge.triangle, k);
    const Vector3d along = mesh.corner(edge.triangle, corner_after(k)) - start;
    const Vector3d side = mesh.corner(edge.triangle, corner_before(k)) - start;
    const double square = dot(along, along);
    const double part = square > 0 ? dot(side, along) / square : 0;
    const double height = square > 0 ? length(cross(along, side)) / square : 0;
    FlatTriangle flat;
    flat[k] = from;
    flat[corner_after(k)] = to;
    flat[corner_before(k)] = from + (to - from) * part + left_of(to - from) * height;
    return flat;
}

FlatTriangle own_frame(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const double size = length(mesh.corner(triangle, 1) - mesh.corner(triangle, 0));
    return lay_flat(mesh, {triangle, 0}, {0, 0}, {size, 0});
}

std::array<double, 3> weights_at(const FlatTriangle& flat, Vector2d point) {
    std::array<double, 3> weights;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Vector2d a = flat[corner_after(k)], b = flat[corner_before(k)];
        weights[k] = std::max(0.0, cross(b - a, point - a));
    }
    const double sum = weights[0] + weights[1] + weights[2];
    if (!(sum > 0)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (double& weight : weights) weight /= sum;
    return weights;
}

WalkEnd walk(const SurfaceMesh& mesh, const SurfacePlace& from, Vector2d step) {
    std::uint32_t triangle = from.triangle;
    FlatTriangle flat = own_frame(mesh, triangle);
    Vector2d point = position_of(flat, from.weights);
    std::uint32_t entered = 3;
    double left = 1;
    for (int crossings = 0; crossings < most_crossings; ++crossings) {
        const EdgeCrossing crossing = first_crossing(flat, point, step * left, entered);
        if (crossing.edge == 3) {
            point = point + step * left;
            left = 0;
            break;
        }
        point = point + step * (left * crossing.part);
        left *= 1 - crossing.part;
        const TriangleEdge other = mesh.across[triangle][crossing.edge];
        if (!other.exists()) break;
        flat = lay_flat(mesh, other, flat[corner_after(crossing.edge)], flat[crossing.edge]);
        triangle = other.triangle;
        entered = other.edge;
    }
    WalkEnd end = {{triangle, weights_at(flat, point)}, 1 - left};
    if (entered != 3) {
        const Vector2d base = flat[1] - flat[0];
        const double size = length(base);
        if (size > 0) end.turn = base * (1 / size);
    }
    return end;
}

}  // namespace cascade
