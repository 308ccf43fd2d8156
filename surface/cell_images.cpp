// The fronts of a place are edges beyond which its image is to be continued. The nearest is
// continued first. A front knows which part of its edge is seen on straight lines (V. Surazhsky et al.,
// "Fast Exact and Approximate Geodesics on Meshes", SIGGRAPH 2005, call it a window): one of which
// nothing is seen waits until all others are done and only fills what they have left.
#include "surface/cell_images.h"

#include <algorithm>
#include <tuple>

namespace cascade {

namespace {

constexpr std::uint32_t after(std::uint32_t k) { return k == 2 ? 0 : k + 1; }

/// An image that is nearer by no more than this nowhere on a triangle is none of its own. In squares
/// of the radius.
constexpr double same_square = 0.02;

/// More images on one triangle than this would be those of a surface crumpled within the radius.
constexpr int most_images = 6;

/// Of an edge, 0 at its start and 1 at its end.
struct Part {
    double low = 0, high = 1;
    bool is_empty() const { return !(high - low > 1e-9); }
};

double square_distance(Vector2d a, Vector2d b) { return dot(a - b, a - b); }

double square_distance_to_edge(Vector2d p, Vector2d a, Vector2d b) {
    const Vector2d along = b - a;
    const double square = dot(along, along);
    const double part = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
    return square_distance(p, a + along * part);
}

/// Leaves of the part of an edge what is on the wanted side of a line; `at_start` and `at_end` are how
/// far the edge's ends are on it.
void clip(Part& part, double at_start, double at_end) {
    if (at_start < 0 && at_end < 0) part = {0, 0};
    if ((at_start < 0) == (at_end < 0)) return;
    const double meeting = at_start / (at_start - at_end);
    if (at_start < 0) part.low = std::max(part.low, meeting);
    if (at_end < 0) part.high = std::min(part.high, meeting);
}

/// What is seen of the edge from `a` to `b` out of `eye` between `left` and `right`.
Part seen_part(Vector2d eye, Vector2d left, Vector2d right, Vector2d a, Vector2d b) {
    Part part;
    clip(part, cross(a - eye, left - eye), cross(b - eye, left - eye));
    clip(part, cross(right - eye, a - eye), cross(right - eye, b - eye));
    return part;
}

class ImageFinder {
public:
    ImageFinder(const SurfaceMesh& mesh, std::span<const FlatTriangle> frames, double radius)
        : mesh_(mesh), frames_(frames), radius_(radius), square_radius_(radius * radius),
          heads_(frames.size()) {}

    void find(std::uint32_t cell, const SurfacePlace& place, std::vector<CellImage>& found) {
        cell_ = cell;
        images_.clear();
        const Vector2d own = position_of(frames_[place.triangle], place.weights);
        continue_image({0, {place.triangle, none}, own, {}});
        drain(fronts_);
        drain(hidden_);
        for (const Image& image : images_) {
            const Vector2d at = image.source * (1 / radius_);
            found.push_back({cell, image.triangle, static_cast<float>(at.x),
                             static_cast<float>(at.y)});
        }
    }

private:
    static constexpr std::uint32_t none = 3;
    static constexpr std::uint32_t no_image = 0xffffffff;

    struct Front {
        double square_distance = 0;
        TriangleEdge into;     ///< The edge through which the triangle is entered.
        Vector2d source;       ///< In the frame of that triangle.
        Part seen;
        friend bool operator<(const Front& a, const Front& b) {
            return std::tie(a.square_distance, a.into.triangle, a.into.edge) >
                   std::tie(b.square_distance, b.into.triangle, b.into.edge);
        }
    };
    struct Image {
        std::uint32_t triangle = 0;
        std::uint32_t next = no_image;  ///< On the same triangle.
        Vector2d source;
    };
    /// The last image on a triangle, if it is one of this cell.
    struct Head {
        std::uint32_t cell = 0;
        std::uint32_t image = no_image;
    };

    std::uint32_t last_image(std::uint32_t triangle) const {
        const Head& head = heads_[triangle];
        return head.cell == cell_ ? head.image : no_image;
    }

    void drain(std::vector<Front>& heap) {
        while (!heap.empty()) {
            std::pop_heap(heap.begin(), heap.end());
            const Front front = heap.back();
            heap.pop_back();
            if (is_wanted(front)) continue_image(front);
        }
    }

    bool is_wanted(const Front& front) const {
        const FlatTriangle& flat = frames_[front.into.triangle];
        int count = 0;
        for (std::uint32_t k = last_image(front.into.triangle); k != no_image;
             k = images_[k].next) {
            const Vector2d other = images_[k].source;
            // The difference of the squares is linear: it is largest at a corner.
            const bool is_nearer = std::any_of(flat.begin(), flat.end(), [&](Vector2d corner) {
                return square_distance(front.source, corner) <
                       square_distance(other, corner) - same_square * square_radius_;
            });
            if (!is_nearer || front.seen.is_empty() || ++count == most_images) return false;
        }
        return true;
    }

    void continue_image(const Front& front) {
        const std::uint32_t triangle = front.into.triangle;
        const FlatTriangle& flat = frames_[triangle];
        images_.push_back({triangle, last_image(triangle), front.source});
        heads_[triangle] = {cell_, static_cast<std::uint32_t>(images_.size() - 1)};
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh_.across[triangle][k];
            if (k == front.into.edge || !other.exists()) continue;
            const Vector2d from = flat[k], to = flat[after(k)];
            const double square = square_distance_to_edge(front.source, from, to);
            if (square >= square_radius_) continue;
            const Part seen = front.into.edge == none ? Part{} : seen_through(front, from, to);
            const Front next = {square, other, carried(front.source, from, to, other),
                                {1 - seen.high, 1 - seen.low}};
            std::vector<Front>& heap = next.seen.is_empty() ? hidden_ : fronts_;
            heap.push_back(next);
            std::push_heap(heap.begin(), heap.end());
        }
    }

    Part seen_through(const Front& front, Vector2d from, Vector2d to) const {
        if (front.seen.is_empty()) return {0, 0};
        const FlatTriangle& flat = frames_[front.into.triangle];
        const Vector2d start = flat[front.into.edge];
        const Vector2d along = flat[after(front.into.edge)] - start;
        return seen_part(front.source, start + along * front.seen.low,
                         start + along * front.seen.high, from, to);
    }

    /// A point of this plane in that of the triangle beyond the edge `from`, `to`.
    Vector2d carried(Vector2d point, Vector2d from, Vector2d to, TriangleEdge other) const {
        const FlatTriangle& flat = frames_[other.triangle];
        const Vector2d there = flat[after(other.edge)];
        const Vector2d along = flat[other.edge] - there, here = to - from;
        const double square = dot(here, here);
        if (!(square > 0)) return there;
        const double part = dot(point - from, here) / square;
        const double side = cross(here, point - from) / square;
        return there + along * part + Vector2d{-along.y, along.x} * side;
    }

    const SurfaceMesh& mesh_;
    std::span<const FlatTriangle> frames_;
    double radius_, square_radius_;
    std::uint32_t cell_ = 0;
    std::vector<Head> heads_;     ///< Per triangle.
    std::vector<Image> images_;   ///< Of this cell.
    std::vector<Front> fronts_, hidden_;
};

}  // namespace

std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle) {
    std::array<double, 3> lengths;
    for (std::uint32_t k = 0; k < 3; ++k) {
        lengths[k] = length(mesh.corner(triangle, after(k)) - mesh.corner(triangle, k));
    }
    return static_cast<std::uint32_t>(std::max_element(lengths.begin(), lengths.end()) -
                                      lengths.begin());
}

FlatTriangle longest_edge_frame(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const std::uint32_t k = longest_edge(mesh, triangle);
    const double size = length(mesh.corner(triangle, after(k)) - mesh.corner(triangle, k));
    return lay_flat(mesh, {triangle, k}, {0, 0}, {size, 0});
}

std::vector<CellImage> cell_images(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                                   double radius, Team& team) {
    std::vector<FlatTriangle> frames;
    frames.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        frames.push_back(longest_edge_frame(mesh, t));
    }
    std::vector<std::vector<CellImage>> found(static_cast<std::size_t>(team.size()));
    team.run([&](int thread) {
        const RowRange part =
            split_rows(static_cast<std::int64_t>(places.size()), thread, team.size());
        ImageFinder finder(mesh, frames, radius);
        for (auto k = static_cast<std::size_t>(part.begin);
             k < static_cast<std::size_t>(part.end); ++k) {
            finder.find(static_cast<std::uint32_t>(k), places[k],
                        found[static_cast<std::size_t>(thread)]);
        }
    });
    std::vector<CellImage> all = std::move(found[0]);
    for (std::size_t thread = 1; thread < found.size(); ++thread) {
        all.insert(all.end(), found[thread].begin(), found[thread].end());
        std::vector<CellImage>().swap(found[thread]);
    }
    return all;
}

}  // namespace cascade
