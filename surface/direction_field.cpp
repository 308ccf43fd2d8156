// Adds lines as vectors at twice their angle, because lines have no sign. Fills in undetermined
// directions in layers, starting next to known directions.
#include "surface/direction_field.h"

#include "surface/coded_directions.h"

#include <algorithm>
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
    // The other triangle has the edge in the opposite direction. The angle is always computed from
    // the triangle with the lower index, so that the links in both directions have exactly opposite
    // angles.
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

constexpr std::uint32_t none = 0xffffffff;

/// Principal curvatures with a smaller relative difference count as equal.
constexpr double least_difference = 1e-3;

/// Assigns directions to planes whose direction is unknown (0), layer after layer.
class Filling {
public:
    Filling(const TangentPlanes& planes, const CodedDirections& coded, std::vector<Vector2d>& codes)
        : planes_(planes), coded_(coded), codes_(codes), layers_(codes.size(), none) {}

    void fill() {
        std::vector<std::uint32_t> known;
        for (std::uint32_t k = 0; k < codes_.size(); ++k) {
            if (length(codes_[k]) > 0.5) known.push_back(k);
        }
        grow(std::move(known));
        for (std::uint32_t k = 0; k < codes_.size(); ++k) {
            if (layers_[k] != none) continue;
            codes_[k] = {1, 0};
            grow({k});
        }
    }

private:
    void grow(std::vector<std::uint32_t> front) {
        for (const std::uint32_t node : front) layers_[node] = 0;
        for (std::uint32_t layer = 1; !front.empty(); ++layer) {
            std::vector<std::uint32_t> next;
            for (const std::uint32_t node : front) {
                for (const TangentLink& link : planes_.links_of(node)) {
                    if (layers_[link.neighbour] != none) continue;
                    layers_[link.neighbour] = layer;
                    next.push_back(link.neighbour);
                }
            }
            for (const std::uint32_t node : next) codes_[node] = from_around(node, layer);
            front.swap(next);
        }
    }

    Vector2d from_around(std::uint32_t node, std::uint32_t layer) const {
        Vector2d sum, first;
        double total = 0;
        for (const TangentLink& link : planes_.links_of(node)) {
            if (layers_[link.neighbour] >= layer) continue;
            const Vector2d carried = product(codes_[link.neighbour], coded_.turn(link));
            const double weight = std::max(link.weight, 1e-12);
            if (total == 0) first = carried;
            sum = sum + carried * weight;
            total += weight;
        }
        return unit_of(length(sum) > cancelled_part * total ? sum : first);
    }

    const TangentPlanes& planes_;
    const CodedDirections& coded_;
    std::vector<Vector2d>& codes_;
    /// The number of links from a known plane; `none` for planes not reached yet.
    std::vector<std::uint32_t> layers_;
};

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

std::vector<Vector3d> directions(const TangentPlanes& planes, std::span<const Vector3d> vectors,
                                 DirectionKind kind, double least_part) {
    const CodedDirections coded(planes, kind);
    // Lengths are relative to the longest vector, so that squares neither overflow nor underflow.
    double longest = 0;
    for (const Vector3d& v : vectors) {
        if (is_finite(v))
            longest = std::max({longest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    }
    std::vector<Vector2d> codes(planes.size());
    for (std::size_t k = 0; k < codes.size() && longest > 0; ++k) {
        const Vector3d& v = vectors[k];
        if (!is_finite(v)) continue;
        const Vector2d code = coded.of(k, {v.x / longest, v.y / longest, v.z / longest});
        if (length(code) > least_part) codes[k] = unit_of(code);
    }
    Filling(planes, coded, codes).fill();
    return coded.in_space(codes);
}

std::vector<Vector3d> axis_directions(const TangentPlanes& planes, Vector3d axis,
                                      DirectionKind kind) {
    return directions(planes, std::vector<Vector3d>(planes.size(), axis), kind);
}

std::vector<Vector3d> gradients_of_points(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                          std::span<const double> values) {
    std::vector<Vector3d> gradients;
    gradients.reserve(planes.size());
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const std::uint32_t triangle = planes.places[k].triangle;
        const auto& corners = mesh.triangles[triangle];
        const FlatTriangle flat = own_frame(mesh, triangle);
        const Vector2d a = flat[1] - flat[0], b = flat[2] - flat[0];
        const double up = values[corners[1]] - values[corners[0]];
        const double left = values[corners[2]] - values[corners[0]];
        const double twice_area = cross(a, b);
        const Vector2d slope = {(up * b.y - left * a.y) / twice_area,
                                (left * a.x - up * b.x) / twice_area};
        const Vector3d gradient = planes.frames[k].in_space(slope);
        gradients.push_back(is_finite(gradient) ? gradient : Vector3d{});
    }
    return gradients;
}

std::vector<Vector3d> curvature_lines(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                      const PrincipalCurvatures& curvature, Principal which) {
    const CodedDirections coded(planes, DirectionKind::lines);
    std::vector<Vector3d> lines;
    lines.reserve(planes.size());
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const SurfacePlace& place = planes.places[k];
        Vector2d sum;
        double size = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t point = mesh.triangles[place.triangle][c];
            const double apart = curvature.high[point] - curvature.low[point];
            size += (std::abs(curvature.high[point]) + std::abs(curvature.low[point])) *
                    place.weights[c];
            sum = sum + coded.of(k, curvature.high_direction[point]) * (apart * place.weights[c]);
        }
        if (!(length(sum) > least_difference * size)) sum = {};
        // The directions of lowest and highest curvature are perpendicular. Angles are doubled
        // here, so the sum is negated.
        if (which == Principal::low) sum = sum * -1.0;
        lines.push_back(coded.in_space(k, sum) * length(sum));
    }
    return lines;
}

}  // namespace cascade
