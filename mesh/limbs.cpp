// Curves become short bones, which are cones with round ends. Limbs near each other are blended.
#include "mesh/limbs.h"

#include "mesh/implicit_surface.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace cascade {

namespace {

constexpr int bones_of_span = 4;
constexpr double steepest = 0.99;  ///< The largest growth of a radius per length.
constexpr double softnesses_of_reach = 4;

Joint operator+(const Joint& a, const Joint& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z, a.radius + b.radius};
}
Joint operator*(const Joint& a, double s) { return {a.x * s, a.y * s, a.z * s, a.radius * s}; }

Vector3d place_of(const Joint& joint) { return {joint.x, joint.y, joint.z}; }

double chord(const Joint& a, const Joint& b) { return length(place_of(b) - place_of(a)); }

/// The slope of the spline at a joint: the slope of the parabola through the joint and its
/// neighbours.
Joint slope_at(const std::vector<Joint>& joints, std::size_t k) {
    const auto slope = [&](std::size_t a) {
        return (joints[a + 1] + joints[a] * -1) * (1 / chord(joints[a], joints[a + 1]));
    };
    if (k == 0) return slope(0);
    if (k + 1 == joints.size()) return slope(k - 1);
    const double before = chord(joints[k - 1], joints[k]), after = chord(joints[k], joints[k + 1]);
    return (slope(k - 1) * after + slope(k) * before) * (1 / (before + after));
}

/// Points along the smooth curve, including the given joints.
std::vector<Joint> curve_through(const std::vector<Joint>& joints) {
    std::vector<Joint> points{joints[0]};
    for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
        const double whole = chord(joints[k], joints[k + 1]);
        const Joint out = slope_at(joints, k) * whole, in = slope_at(joints, k + 1) * whole;
        for (int step = 1; step <= bones_of_span; ++step) {
            const double t = static_cast<double>(step) / bones_of_span;
            const double rest = 1 - t;
            points.push_back(joints[k] * (rest * rest * (1 + 2 * t)) + out * (rest * rest * t) +
                             joints[k + 1] * (t * t * (1 + 2 * rest)) + in * (-t * t * rest));
        }
    }
    return points;
}

Vector3d divided(Vector3d a, Vector3d b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

Vector3d least(Vector3d a, Vector3d b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vector3d greatest(Vector3d a, Vector3d b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// A box that contains the flesh around the points.
SurfaceMesh::Box box_of(const std::vector<Joint>& points) {
    SurfaceMesh::Box box{place_of(points[0]), place_of(points[0])};
    for (const Joint& point : points) {
        const Vector3d around{point.radius, point.radius, point.radius};
        box.low = least(box.low, place_of(point) - around);
        box.high = greatest(box.high, place_of(point) + around);
    }
    return box;
}

}  // namespace

LimbBody::Bone::Bone(Vector3d start, double from_radius, Vector3d to, double to_radius)
    : from(start),
      direction(unit(to - start)),
      extent(length(to - start)),
      radius(from_radius),
      // If one ball contains the other, no cone touches both, so the growth is limited.
      growth(extent > 0 ? std::clamp((to_radius - from_radius) / extent, -steepest, steepest) : 0),
      lean(growth / std::sqrt(1 - growth * growth)),
      // The radius is slightly larger than needed, because of rounding.
      ball{start + direction * (extent / 2),
           1.000001 * (extent / 2 + std::max(radius, radius + growth * extent))} {}

// Written with plain comparisons, so that compilers vectorise the loop.
WITH_WIDE_VECTORS void LimbBody::Bone::lower(Numbers& distances, const Block& points) const {
    for (std::size_t k = 0; k < block_size; ++k) {
        const Vector3d away{points.x[k] - from.x, points.y[k] - from.y, points.z[k] - from.z};
        const double along = dot(away, direction);
        const double square = dot(away, away) - along * along;
        const double aside = std::sqrt(square > 0 ? square : 0);
        // Projects the point onto the bone, to the centre of the ball whose flesh is nearest.
        const double nearest = along + lean * aside;
        const double place = nearest < 0 ? 0 : nearest > extent ? extent : nearest;
        const double rest = along - place;
        const double distance = std::sqrt(aside * aside + rest * rest) - radius - growth * place;
        distances[k] = distance < distances[k] ? distance : distances[k];
    }
}

SurfaceMesh::Box LimbBody::Block::box() const {
    const auto [left, right] = std::ranges::minmax(x);
    const auto [bottom, top] = std::ranges::minmax(y);
    const auto [back, front] = std::ranges::minmax(z);
    return {{left, bottom, back}, {right, top, front}};
}

LimbBody::LimbBody(const std::vector<Limb>& limbs) {
    for (const Limb& limb : limbs) {
        add(limb, 1);
        if (limb.sides == Sides::both) add(limb, -1);
    }
}

void LimbBody::add(const Limb& limb, double side) {
    std::vector<Joint> points = curve_through(limb.joints);
    for (Joint& point : points) point.x *= side;
    if (points.size() == 1) points.push_back(points[0]);
    const auto flattened = [&](const Joint& point) { return divided(place_of(point), limb.flat); };
    const std::size_t first = bones_.size();
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        bones_.emplace_back(flattened(points[k]), points[k].radius, flattened(points[k + 1]),
                            points[k + 1].radius);
    }
    parts_.push_back({first, bones_.size(), limb.softness, limb.flat, box_of(points)});
}

double LimbBody::operator()(Vector3d p) const {
    double value = 0;
    evaluate({&p, 1}, {&value, 1});
    return value;
}

void LimbBody::evaluate(std::span<const Vector3d> points, std::span<double> values) const {
    for (std::size_t first = 0; first < points.size(); first += block_size) {
        const std::size_t count = std::min(block_size, points.size() - first);
        Block block;
        for (std::size_t k = 0; k < block_size; ++k) {
            const Vector3d& p = points[first + std::min(k, count - 1)];
            block.x[k] = p.x;
            block.y[k] = p.y;
            block.z[k] = p.z;
        }
        const SurfaceMesh::Box box = block.box();
        Numbers sums;
        sums.fill(-1);
        for (const Part& part : parts_) add_part(part, block, box, sums);
        std::copy_n(sums.data(), count, values.data() + first);
    }
}

/// Adds the terms of a limb at the points, which lie in the box.
void LimbBody::add_part(const Part& part, const Block& points, const SurfaceMesh::Box& box,
                        Numbers& sums) const {
    const double reach = softnesses_of_reach * part.softness;
    const Vector3d gap = greatest({}, greatest(part.box.low - box.high, box.low - part.box.high));
    if (dot(gap, gap) >= reach * reach) return;
    Block flattened;
    for (std::size_t k = 0; k < block_size; ++k) {
        flattened.x[k] = points.x[k] / part.flat.x;
        flattened.y[k] = points.y[k] / part.flat.y;
        flattened.z[k] = points.z[k] / part.flat.z;
    }
    const Vector3d low = divided(box.low, part.flat), high = divided(box.high, part.flat);
    const Ball ball{(low + high) * 0.5, 0.500001 * length(high - low)};
    Numbers distances;
    distances.fill(reach);
    double largest = reach;
    for (std::size_t bone = part.first; bone < part.last; ++bone) {
        // Skips bones too far away to be nearest to any point.
        const Vector3d away = bones_[bone].ball.middle - ball.middle;
        const double most = std::max(largest + bones_[bone].ball.radius + ball.radius, 0.0);
        if (dot(away, away) > most * most) continue;
        bones_[bone].lower(distances, flattened);
        largest = std::ranges::max(distances);
    }
    for (std::size_t k = 0; k < block_size; ++k) {
        const double term = 1 - distances[k] / reach;
        sums[k] += term * term * term * term;
    }
}

Result<SurfaceMesh> LimbBody::mesh(double edge, const std::atomic<bool>& cancel) const {
    const auto function = [this](std::span<const Vector3d> points, std::span<double> values) {
        evaluate(points, values);
    };
    SurfaceMesh::Box box = parts_[0].box;
    for (const Part& part : parts_) {
        const double reach = softnesses_of_reach * part.softness;
        const Vector3d around{reach, reach, reach};
        box.low = least(box.low, part.box.low - around);
        box.high = greatest(box.high, part.box.high + around);
    }
    Result<SurfaceMesh> mesh = implicit_surface(function, {box.low, box.high, edge}, cancel);
    if (!mesh) return mesh;
    const double ground = mesh->box().low.y;
    for (Vector3d& p : mesh->points) p.y -= ground;
    return mesh;
}

}  // namespace cascade
