// Searches a bounding volume hierarchy that is split at the median triangle.
#include "surface/nearest_place.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace cascade {

namespace {

constexpr std::uint32_t most_in_leaf = 4;

/// A point farther away than this multiple of the model's size is moved nearer along a straight
/// line. This does not change the nearest position. Without the move, rounding would make all
/// distances equal.
constexpr double farthest_kept = 1e5;

double square_distance(Vector3d a, Vector3d b) { return dot(a - b, a - b); }

double square_distance(Vector3d low, Vector3d high, Vector3d point) {
    const Vector3d inside = {std::clamp(point.x, low.x, high.x), std::clamp(point.y, low.y, high.y),
                             std::clamp(point.z, low.z, high.z)};
    return square_distance(inside, point);
}

Vector3d smaller(Vector3d a, Vector3d b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vector3d larger(Vector3d a, Vector3d b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

std::array<Vector3d, 3> corners_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    return {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)};
}

}  // namespace

std::array<double, 3> nearest_weights(const std::array<Vector3d, 3>& corners, Vector3d point) {
    const Vector3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    std::array<double, 3> weights;
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        weights[k] = dot(cross(b - a, point - a), normal);
        is_inside = is_inside && weights[k] > 0;
    }
    const double sum = weights[0] + weights[1] + weights[2];
    if (is_inside && std::isfinite(sum)) {
        for (double& weight : weights) weight /= sum;
        return weights;
    }
    // If the projection is outside of the triangle, the nearest point is on an edge.
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d a = corners[k], b = corners[(k + 1) % 3];
        const double part = nearest_fraction(a, b, point);
        const double distance = square_distance(a + (b - a) * part, point);
        if (distance >= best) continue;
        best = distance;
        weights[k] = 1 - part;
        weights[(k + 1) % 3] = part;
        weights[(k + 2) % 3] = 0;
    }
    return best < std::numeric_limits<double>::infinity() ? weights : std::array{1.0, 0.0, 0.0};
}

struct NearestPlace::Best {
    double distance = std::numeric_limits<double>::infinity();  ///< Squared.
    SurfacePlace place{TriangleEdge::none, {1, 0, 0}};
};

NearestPlace::NearestPlace(const SurfaceMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    if (order_.empty()) return;
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::vector<Vector3d> middles;
    middles.reserve(order_.size());
    for (std::uint32_t t = 0; t < order_.size(); ++t) {
        const auto [a, b, c] = corners_of(mesh, t);
        middles.push_back((a + b + c) * (1.0 / 3));
    }
    boxes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(order_.size()), 0});
    // The loop appends boxes to the list. There are fewer boxes than triangles.
    for (std::uint32_t box = 0; box < boxes_.size(); ++box) {
        fit(boxes_[box]);
        if (boxes_[box].count > most_in_leaf) split(box, middles);
    }
}

void NearestPlace::fit(Box& box) const {
    box.low = box.high = mesh_.corner(order_[box.first], 0);
    for (std::uint32_t k = 0; k < box.count; ++k) {
        for (const Vector3d& corner : corners_of(mesh_, order_[box.first + k])) {
            box.low = smaller(box.low, corner);
            box.high = larger(box.high, corner);
        }
    }
}

void NearestPlace::split(std::uint32_t number, std::span<const Vector3d> middles) {
    const Box box = boxes_[number];
    const Vector3d size = box.high - box.low;
    double Vector3d::*const axis = size.x >= size.y && size.x >= size.z ? &Vector3d::x
                                   : size.y >= size.z                   ? &Vector3d::y
                                                                        : &Vector3d::z;
    const auto begin = order_.begin() + box.first;
    const std::uint32_t half = box.count / 2;
    std::nth_element(begin, begin + half, begin + box.count, [&](std::uint32_t a, std::uint32_t b) {
        const double at_a = middles[a].*axis, at_b = middles[b].*axis;
        return at_a < at_b || (at_a == at_b && a < b);
    });
    boxes_[number].count = 0;
    boxes_[number].part = static_cast<std::uint32_t>(boxes_.size());
    boxes_.push_back({{}, {}, box.first, half, 0});
    boxes_.push_back({{}, {}, box.first + half, box.count - half, 0});
}

void NearestPlace::search(const Box& box, Vector3d point, Best& best) const {
    if (box.count == 0) {
        const Box *near = &boxes_[box.part], *far = near + 1;
        double to_near = square_distance(near->low, near->high, point);
        double to_far = square_distance(far->low, far->high, point);
        if (to_far < to_near) {
            std::swap(near, far);
            std::swap(to_near, to_far);
        }
        // A box at the same distance may contain a triangle with a lower index, so it is searched,
        // too.
        if (to_near <= best.distance) search(*near, point, best);
        if (to_far <= best.distance) search(*far, point, best);
        return;
    }
    for (std::uint32_t k = box.first; k < box.first + box.count; ++k) {
        const std::uint32_t triangle = order_[k];
        const SurfacePlace place = {triangle, nearest_weights(corners_of(mesh_, triangle), point)};
        const double distance = square_distance(position_of(mesh_, place), point);
        if (distance < best.distance ||
            (distance == best.distance && triangle < best.place.triangle)) {
            best = {distance, place};
        }
    }
}

std::optional<SurfacePlace> NearestPlace::find(Vector3d point) const {
    if (boxes_.empty() || !is_finite(point)) return std::nullopt;
    const Box& all = boxes_[0];
    const Vector3d middle = (all.low + all.high) * 0.5;
    const double size = length(all.high - all.low);
    // A quarter of the vector is used, because the whole vector may overflow.
    const Vector3d part = point * 0.25 - middle * 0.25;
    const double away = std::hypot(part.x, part.y, part.z);
    if (away > farthest_kept * size / 4) {
        const Vector3d towards = {part.x / away, part.y / away, part.z / away};
        point = middle + towards * (farthest_kept * size);
    }
    Best best;
    search(all, point, best);
    return best.place;
}

}  // namespace cascade
