#include "surface/remove_points.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr double boundary_may_move = 0.1;            ///< Spacings.
constexpr double longest_boundary_edge = 2;          ///< Spacings.
constexpr double high_care = 0.26, low_care = 0.09;  ///< Cosines of 75° and 85°.
constexpr std::size_t most_tried = 24;  ///< Points of a rim of which all ways to fill it are tried.
constexpr double least_sine = 1e-9;

bool is_fine(const TriangleQuality& quality, Care care) {
    if (quality.least_sine < least_sine) return false;
    return care == Care::high ? quality.least_cosine > high_care : quality.mean_cosine > low_care;
}

double distance_to_segment(Vector3d point, Vector3d from, Vector3d to) {
    const Vector3d along = to - from;
    const double square = dot(along, along);
    const double part = square > 0 ? std::clamp(dot(point - from, along) / square, 0.0, 1.0) : 0;
    return length(point - from - along * part);
}

}  // namespace

/// The boundary comes from the rim's last point and goes on to its first.
bool PointRemoval::may_leave_boundary(std::uint32_t point) {
    const auto& points = mesh_.mesh().points;
    const Vector3d from = points[fan_.rim.back()], to = points[fan_.rim.front()];
    const double moved = distance_to_segment(points[point], from, to) +
                         std::max(moved_[fan_.rim.back()], moved_[point]);
    return moved <= boundary_may_move * spacing_ &&
           length(to - from) <= longest_boundary_edge * spacing_;
}

void PointRemoval::note_moved(std::uint32_t point) {
    const auto& points = mesh_.mesh().points;
    double& moved = moved_[fan_.rim.back()];
    moved = std::max(moved, moved_[point]) +
            distance_to_segment(points[point], points[fan_.rim.back()], points[fan_.rim.front()]);
}

bool PointRemoval::has_rim_twice() {
    sorted_ = fan_.rim;
    std::sort(sorted_.begin(), sorted_.end());
    return std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
}

/// Whether the hole's last edge, or a hole of three corners as a whole, meets nothing of the kind.
bool PointRemoval::may_close() {
    const std::vector<std::uint32_t>& rim = fan_.rim;
    if (!fan_.is_closed) {
        if (rim.size() == 2) return fan_.beyond[0].exists();
        if (mesh_.are_neighbours(rim.back(), rim.front())) return false;
    }
    if (rim.size() != 3) return rim.size() > 3 || !fan_.is_closed;
    const TriangleEdge other = fan_.beyond[0];
    return !other.exists() ||
           mesh_.mesh().triangles[other.triangle][corner_before(other.edge)] != rim[2];
}

void PointRemoval::unroll_fan(std::uint32_t point) {
    const auto& points = mesh_.mesh().points;
    distances_.clear();
    angles_.clear();
    for (const std::uint32_t other : fan_.rim) {
        distances_.push_back(length(points[other] - points[point]));
    }
    for (std::size_t k = 0; k < fan_.triangles.size(); ++k) {
        const Vector3d a = points[fan_.rim[k]] - points[point];
        const Vector3d b = points[fan_.rim[k + 1 == fan_.rim.size() ? 0 : k + 1]] - points[point];
        angles_.push_back(std::atan2(length(cross(a, b)), dot(a, b)));
    }
    flat_ = unroll(distances_, angles_);
}

TriangleQuality PointRemoval::quality(const RimTriangle& corners) const {
    const auto& points = mesh_.mesh().points;
    const std::uint32_t a = fan_.rim[corners[0]], b = fan_.rim[corners[1]];
    const std::uint32_t c = fan_.rim[corners[2]];
    return quality_of({points[a], points[b], points[c]}, {normals_[a], normals_[b], normals_[c]});
}

/// Whether the line from the first to the third corner is a side of the rim or no edge yet.
bool PointRemoval::is_new(const RimTriangle& corners) {
    const std::uint32_t reach =
        corners[2] > corners[0] ? corners[2] - corners[0] : corners[0] - corners[2];
    if (reach == 1 || reach + 1 == fan_.rim.size()) return true;
    const bool is_there = mesh_.are_neighbours(fan_.rim[corners[0]], fan_.rim[corners[2]]);
    meets_edge_ |= is_there;
    return !is_there;
}

/// All ways to fill the hole are tried.
std::vector<RimTriangle> PointRemoval::best_filling(Care care) {
    const auto count = static_cast<std::uint32_t>(fan_.rim.size());
    return best_triangles(count, [&](const RimTriangle& corners) {
        const TriangleQuality found = quality(corners);
        return is_fine(found, care) && is_new(corners) ? found.score() : 0;
    });
}

/// The same ear by ear, in the plane into which the fan is unrolled.
std::vector<RimTriangle> PointRemoval::cut_ears_around(std::uint32_t point, Care care) {
    unroll_fan(point);
    return cut_ears(flat_, fan_.is_closed, [&](const RimTriangle& corners) {
        return is_new(corners) && is_fine(quality(corners), care);
    });
}

std::optional<WhyKept> PointRemoval::remove(std::uint32_t point, Care care) {
    mesh_.fan_around(point, fan_);
    if (!fan_.is_closed && !may_leave_boundary(point)) return WhyKept::boundary;
    if (has_rim_twice() || !may_close()) return WhyKept::topology;
    std::vector<RimTriangle> triangles;
    if (fan_.rim.size() > 2) {
        meets_edge_ = false;
        triangles =
            fan_.rim.size() <= most_tried ? best_filling(care) : cut_ears_around(point, care);
        if (triangles.empty()) return meets_edge_ ? WhyKept::topology : WhyKept::fold;
    }
    if (!fan_.is_closed) note_moved(point);
    mesh_.replace_fan(point, fan_, triangles);
    return std::nullopt;
}

}  // namespace cascade
