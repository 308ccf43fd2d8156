// Propagates an image from the position's triangle across edges, nearest edges first and each edge
// once. An unfolded strip of triangles may wind back to its start. Propagation ends there, because
// the image would be nearer along the surface than in space, and such images are rejected.
#include "surface/cell_images.h"

#include <algorithm>
#include <functional>

namespace cascade {

namespace {

/// The square of the distance from a point to the segment from a to b.
template <typename Vector>
double square_distance(const Vector& p, const Vector& a, const Vector& b) {
    const Vector apart = p - (a + (b - a) * nearest_fraction(a, b, p));
    return dot(apart, apart);
}

}  // namespace

ImageFinder::ImageFinder(const SurfaceMesh& mesh, std::span<const FlatTriangle> frames,
                         double radius)
    : mesh_(mesh), frames_(frames), radius_(radius), last_seen_(frames.size()) {}

std::span<const CellImage> ImageFinder::find(const SurfacePlace& place) {
    ++call_;
    position_ = position_of(mesh_, place);
    seen_.clear();
    enter({place.triangle, none}, position_of(frames_[place.triangle], place.weights));
    while (!fronts_.empty()) {
        std::pop_heap(fronts_.begin(), fronts_.end(), std::greater());
        const auto number = static_cast<std::uint64_t>(fronts_.back());
        fronts_.pop_back();
        hand_on(static_cast<std::uint32_t>(number / 4), number % 4);
    }
    images_.clear();
    for (const Seen& seen : seen_) {
        CellImage& image = images_.emplace_back();
        image.triangle = seen.triangle;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vector2d at = seen.from_edges[k] * (1 / radius_);
            image.from_edges[k] = {static_cast<float>(at.x), static_cast<float>(at.y)};
        }
    }
    return images_;
}

void ImageFinder::enter(TriangleEdge edge, Vector2d source) {
    const std::uint32_t triangle = edge.triangle;
    const auto number = static_cast<std::uint32_t>(seen_.size());
    last_seen_[triangle] = {call_, number};
    Seen& seen = seen_.emplace_back();
    seen.triangle = triangle;
    for (Vector2d& from_edge : seen.from_edges) from_edge = source;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const TriangleEdge& other = mesh_.across[triangle][k];
        if (k == edge.edge || !other.exists()) continue;
        const double along =
            square_distance(source, frames_[triangle][k], frames_[triangle][corner_after(k)]);
        if (along >= radius_ * radius_) continue;
        const double in_space = square_distance(position_, mesh_.corner(triangle, k),
                                                mesh_.corner(triangle, corner_after(k)));
        const double square = std::max(along, in_space);
        if (square >= radius_ * radius_) continue;
        __builtin_prefetch(&frames_[other.triangle]);
        __builtin_prefetch(&mesh_.triangles[other.triangle]);
        __builtin_prefetch(&mesh_.across[other.triangle]);
        fronts_.push_back(front_at(square, number, k));
        std::push_heap(fronts_.begin(), fronts_.end(), std::greater());
    }
}

void ImageFinder::hand_on(std::uint32_t seen, std::uint32_t edge) {
    Seen& here = seen_[seen];
    if (here.is_reached[edge]) return;
    here.is_reached[edge] = true;
    const TriangleEdge other = mesh_.across[here.triangle][edge];
    const Vector2d source = carried({here.triangle, edge}, other, here.from_edges[edge]);
    if (last_seen_[other.triangle].call != call_) enter(other, source);
    Seen& there = seen_[last_seen_[other.triangle].number];
    there.is_reached[other.edge] = true;
    there.from_edges[other.edge] = source;
}

/// Maps a point from the plane of one triangle to the plane of the other.
Vector2d ImageFinder::carried(TriangleEdge edge, TriangleEdge other, Vector2d point) const {
    const FlatTriangle& from = frames_[edge.triangle];
    const FlatTriangle& into = frames_[other.triangle];
    const Vector2d here = from[corner_after(edge.edge)] - from[edge.edge];
    const Vector2d there = into[other.edge] - into[corner_after(other.edge)];
    const double square = dot(here, here);
    if (!(square > 0)) return into[other.edge];
    const double part = dot(point - from[edge.edge], here) / square;
    const double side = cross(here, point - from[edge.edge]) / square;
    return into[corner_after(other.edge)] + there * part + Vector2d{-there.y, there.x} * side;
}

std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle) {
    std::array<double, 3> lengths;
    for (std::uint32_t k = 0; k < 3; ++k) {
        lengths[k] = length(mesh.corner(triangle, corner_after(k)) - mesh.corner(triangle, k));
    }
    return static_cast<std::uint32_t>(std::max_element(lengths.begin(), lengths.end()) -
                                      lengths.begin());
}

std::vector<FlatTriangle> longest_edge_frames(const SurfaceMesh& mesh) {
    std::vector<FlatTriangle> frames;
    frames.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t k = longest_edge(mesh, t);
        const double size = length(mesh.corner(t, corner_after(k)) - mesh.corner(t, k));
        frames.push_back(lay_flat(mesh, {t, k}, {0, 0}, {size, 0}));
    }
    return frames;
}

}  // namespace cascade
