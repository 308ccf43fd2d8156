// Goes across edges from the position's triangle outwards and rotates each next triangle into the
// plane, until all edges of the front are out of reach.
#include "surface/unfolding.h"

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

/// The square of the distance from the origin to the segment between two points.
double square_to(Vector2d a, Vector2d b) {
    const Vector2d along = b - a;
    const double square = dot(along, along), part = -dot(a, along);
    if (part <= 0) return dot(a, a);
    if (part >= square) return dot(b, b);
    const double height = cross(a, along);
    return height * height / square;
}

}  // namespace

EdgeShapes::EdgeShapes(const SurfaceMesh& mesh) {
    shapes_.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<Vector2d, 3> shape;
        for (std::uint32_t k = 0; k < 3; ++k) {
            shape[k] = lay_flat(mesh, {t, k}, {0, 0}, {1, 0})[corner_before(k)];
        }
        shapes_.push_back(shape);
    }
}

template <typename Metric>
void Unfolding::add(std::uint32_t triangle, const FlatTriangle& flat, std::uint32_t entered,
                    double square, double square_of_longest, const Metric& metric) {
    const auto piece = static_cast<std::uint32_t>(pieces_.size());
    pieces_.push_back({triangle, flat});
    marks_[triangle] = first_mark_ + static_cast<std::uint32_t>(pieces_.size());
    for (std::uint32_t k = 0; k < 3; ++k) {
        const TriangleEdge other = mesh_.across[triangle][k];
        if (k == entered || !other.exists() || flat_of(other.triangle)) continue;
        const double distance = square_to(metric(flat[corner_after(k)]), metric(flat[k]));
        if (distance > square || square_in_space(triangle, k) > square_of_longest) {
            is_everything_ = false;
            continue;
        }
        fronts_.push_back({distance, piece, k});
        std::push_heap(fronts_.begin(), fronts_.end());
    }
}

/// The square of the distance in space from the position to an edge.
double Unfolding::square_in_space(std::uint32_t triangle, std::uint32_t edge) const {
    const Vector3d a = mesh_.corner(triangle, edge) - position_;
    const Vector3d b = mesh_.corner(triangle, corner_after(edge)) - position_;
    const Vector3d nearest = a + (b - a) * nearest_fraction(a, b, {});
    return dot(nearest, nearest);
}

std::span<const Unfolding::Piece> Unfolding::around(const SurfacePlace& place, double radius) {
    return spread(place, radius, radius, [](Vector2d v) { return v; });
}

std::span<const Unfolding::Piece> Unfolding::around(const SurfacePlace& place, double radius,
                                                    const Stretch& metric) {
    return spread(place, radius, radius * metric.longest(), metric);
}

/// Paths of at most `radius` in the metric are at most `longest` on the surface.
template <typename Metric>
std::span<const Unfolding::Piece> Unfolding::spread(const SurfacePlace& place, double radius,
                                                    double longest, const Metric& metric) {
    const double square_of_radius = radius * radius, square_of_longest = longest * longest;
    first_mark_ += static_cast<std::uint32_t>(pieces_.size());
    if (first_mark_ > std::numeric_limits<std::uint32_t>::max() - marks_.size()) {
        std::fill(marks_.begin(), marks_.end(), 0);
        first_mark_ = 0;
    }
    pieces_.clear();
    fronts_.clear();
    is_everything_ = true;
    position_ = position_of(mesh_, place);
    FlatTriangle flat = own_frame(mesh_, place.triangle);
    const Vector2d origin = position_of(flat, place.weights);
    for (Vector2d& corner : flat) corner = corner - origin;
    add(place.triangle, flat, 3, square_of_radius, square_of_longest, metric);
    while (!fronts_.empty()) {
        std::pop_heap(fronts_.begin(), fronts_.end());
        const auto [square, number, edge] = fronts_.back();
        fronts_.pop_back();
        const Piece& piece = pieces_[number];
        const TriangleEdge into = mesh_.across[piece.triangle][edge];
        if (flat_of(into.triangle)) continue;
        const std::uint32_t k = into.edge;
        flat[k] = piece.flat[corner_after(edge)];
        flat[corner_after(k)] = piece.flat[edge];
        flat[corner_before(k)] = shapes_.apex(into, flat[k], flat[corner_after(k)]);
        add(into.triangle, flat, k, square_of_radius, square_of_longest, metric);
    }
    return pieces_;
}

}  // namespace cascade
