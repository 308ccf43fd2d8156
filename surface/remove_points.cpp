// Decides which points may be removed and how holes are filled. OpenMesh flips and collapses edges.
#include "surface/remove_points.h"

#include <algorithm>

namespace cascade {

namespace {

/// The largest movement of a boundary, as a multiple of the spacing.
constexpr double boundary_may_move = 0.1;
/// The longest edge, as a multiple of the spacing.
constexpr double longest_boundary_edge = 2;
constexpr double high_care = 0.26, low_care = 0.09;  ///< The cosines of 75° and 85°.
constexpr std::size_t most_tried = 24;  ///< In larger rings, not all triangulations are tried.
constexpr double least_sine = 1e-9;

bool is_fine(const TriangleQuality& quality, Care care) {
    if (quality.least_sine < least_sine) return false;
    return care == Care::high ? quality.least_cosine > high_care : quality.mean_cosine > low_care;
}

double distance_to_segment(Vector3d point, Vector3d from, Vector3d to) {
    return length(point - from - (to - from) * nearest_fraction(from, to, point));
}

}  // namespace

void PointRemoval::take_ring(std::uint32_t point) {
    outgoing(mesh_, vertex(point), spokes_);
    is_closed_ = !mesh_.is_boundary(spokes_.back());
    ring_.clear();
    for (const HalfedgeHandle spoke : spokes_)
        ring_.push_back(number(mesh_.to_vertex_handle(spoke)));
}

/// Whether removing a point from the boundary would move the boundary only a little. The boundary
/// runs from the ring's last point through `point` to the ring's first point.
bool PointRemoval::may_leave_boundary(std::uint32_t point) {
    const Vector3d from = place(ring_.back()), to = place(ring_.front());
    const double moved =
        distance_to_segment(place(point), from, to) + std::max(moved_[ring_.back()], moved_[point]);
    return moved <= boundary_may_move * spacing_ &&
           length(to - from) <= longest_boundary_edge * spacing_;
}

void PointRemoval::note_moved(std::uint32_t point) {
    double& moved = moved_[ring_.back()];
    moved = std::max(moved, moved_[point]) +
            distance_to_segment(place(point), place(ring_.back()), place(ring_.front()));
}

bool PointRemoval::has_point_twice() {
    sorted_ = ring_;
    std::sort(sorted_.begin(), sorted_.end());
    return std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
}

/// Whether the last edge that closes the hole, or the last three corners, make no duplicate edge or
/// triangle.
bool PointRemoval::may_close() {
    const HalfedgeHandle beyond =
        mesh_.opposite_halfedge_handle(mesh_.next_halfedge_handle(spokes_[0]));
    if (!is_closed_) {
        if (ring_.size() == 2) return !mesh_.is_boundary(beyond);
        if (are_neighbours(mesh_, vertex(ring_.back()), vertex(ring_.front()))) return false;
    }
    if (ring_.size() != 3) return ring_.size() > 3 || !is_closed_;
    return mesh_.is_boundary(beyond) || number(mesh_.opposite_vh(beyond)) != ring_[2];
}

void PointRemoval::unroll_ring(std::uint32_t point) {
    distances_.clear();
    angles_.clear();
    for (const std::uint32_t other : ring_)
        distances_.push_back(length(place(other) - place(point)));
    for (std::size_t k = 0; k + !is_closed_ < ring_.size(); ++k) {
        const Vector3d a = place(ring_[k]) - place(point);
        const Vector3d b = place(ring_[k + 1 == ring_.size() ? 0 : k + 1]) - place(point);
        angles_.push_back(std::atan2(length(cross(a, b)), dot(a, b)));
    }
    flat_ = unroll(distances_, angles_);
}

TriangleQuality PointRemoval::quality(const RingTriangle& corners) const {
    const std::uint32_t a = ring_[corners[0]], b = ring_[corners[1]], c = ring_[corners[2]];
    return quality_of({place(a), place(b), place(c)}, {normals_[a], normals_[b], normals_[c]});
}

/// Whether the first and third corner of a triangle are adjacent on the ring, or not joined by an
/// edge yet.
bool PointRemoval::is_new(const RingTriangle& corners) {
    const std::uint32_t reach =
        corners[2] > corners[0] ? corners[2] - corners[0] : corners[0] - corners[2];
    if (reach == 1 || reach + 1 == ring_.size()) return true;
    const bool is_there =
        are_neighbours(mesh_, vertex(ring_[corners[0]]), vertex(ring_[corners[2]]));
    meets_edge_ |= is_there;
    return !is_there;
}

/// The best of all triangulations of the hole.
std::vector<RingTriangle> PointRemoval::best_filling(Care care) {
    const auto count = static_cast<std::uint32_t>(ring_.size());
    // The last triangle for which is_new() was tested. Triangles with the same new edge are
    // requested one after another.
    RingTriangle asked{};
    bool may_be = false;
    return best_triangles(count, [&](const RingTriangle& corners) {
        const TriangleQuality found = quality(corners);
        if (!is_fine(found, care)) return 0.0;
        if (corners[0] != asked[0] || corners[2] != asked[2]) may_be = is_new(corners);
        asked = corners;
        return may_be ? found.score() : 0;
    });
}

/// Triangulates the hole by cutting ears, in the plane into which the ring is unrolled.
std::vector<RingTriangle> PointRemoval::cut_ears_around(std::uint32_t point, Care care) {
    unroll_ring(point);
    return cut_ears(flat_, is_closed_, [&](const RingTriangle& corners) {
        return is_new(corners) && is_fine(quality(corners), care);
    });
}

/// Cuts off each ear by flipping the edge from the point to the ear's tip. In the end, the three
/// triangles around an inner point are merged into one. At a boundary, the last triangle is
/// deleted.
void PointRemoval::fill(std::span<const RingTriangle> triangles) {
    changed_.clear();
    for (const HalfedgeHandle spoke : spokes_) {
        if (!mesh_.is_boundary(spoke)) changed_.push_back(mesh_.face_handle(spoke));
    }
    for (const auto& [before, tip, after] : triangles.first(triangles.size() - is_closed_)) {
        mesh_.flip(mesh_.edge_handle(spokes_[tip]));
    }
    if (is_closed_) mesh_.collapse(spokes_[triangles.back()[0]]);
    else mesh_.delete_face(mesh_.face_handle(spokes_[0]));
}

std::optional<WhyKept> PointRemoval::remove(std::uint32_t point, Care care) {
    take_ring(point);
    if (!is_closed_ && !may_leave_boundary(point)) return WhyKept::boundary;
    if (has_point_twice() || !may_close()) return WhyKept::topology;
    std::vector<RingTriangle> triangles;
    if (ring_.size() > 2) {
        meets_edge_ = false;
        triangles = ring_.size() <= most_tried ? best_filling(care) : cut_ears_around(point, care);
        if (triangles.empty()) return meets_edge_ ? WhyKept::topology : WhyKept::fold;
    }
    if (!is_closed_) note_moved(point);
    fill(triangles);
    return std::nullopt;
}

}  // namespace cascade
