// From the triangle of a place its image is propagated over edges, the nearest first, over each
// edge once. An unfolded strip of triangles may wind back to its start; it ends there because a
// path along the surface that is shorter than the distance in space is rejected.
#include "surface/cell_images.h"

#include <algorithm>
#include <tuple>

namespace cascade {

namespace {

/// The square of the distance from a point to the segment from a to b.
template <typename Vector>
double square_distance(const Vector& p, const Vector& a, const Vector& b) {
    const Vector apart = p - (a + (b - a) * nearest_fraction(a, b, p));
    return dot(apart, apart);
}

class ImageFinder {
public:
    ImageFinder(const SurfaceMesh& mesh, std::span<const FlatTriangle> frames, double radius)
        : mesh_(mesh), frames_(frames), radius_(radius), last_seen_(frames.size()) {}

    void find(std::uint32_t cell, const SurfacePlace& place, std::vector<CellImage>& found) {
        cell_ = cell;
        position_ = position_of(mesh_, place);
        seen_.clear();
        enter({place.triangle, none}, position_of(frames_[place.triangle], place.weights));
        while (!fronts_.empty()) {
            std::pop_heap(fronts_.begin(), fronts_.end());
            const Front front = fronts_.back();
            fronts_.pop_back();
            hand_on(front);
        }
        for (const Seen& seen : seen_) {
            CellImage image{cell, seen.triangle, {}};
            for (std::uint32_t k = 0; k < 3; ++k) {
                const Vector2d at = seen.from_edges[k] * (1 / radius_);
                image.from_edges[k] = {static_cast<float>(at.x), static_cast<float>(at.y)};
            }
            found.push_back(image);
        }
    }

private:
    static constexpr std::uint32_t none = 3;

    /// A visited triangle.
    struct Seen {
        std::uint32_t triangle = 0;
        std::array<bool, 3> is_reached{};  ///< Edges crossed by an image.
        std::array<Vector2d, 3> from_edges;
    };
    /// An edge of a visited triangle.
    struct Front {
        double square_distance = 0;
        std::uint32_t seen = 0;
        std::uint32_t edge = 0;
        friend bool operator<(const Front& a, const Front& b) {
            return std::tie(a.square_distance, a.seen, a.edge) >
                   std::tie(b.square_distance, b.seen, b.edge);
        }
    };
    /// The index in seen_ of a triangle's visit from `cell`.
    struct LastSeen {
        std::uint32_t cell = TriangleEdge::none;
        std::uint32_t number = 0;
    };

    void enter(TriangleEdge edge, Vector2d source) {
        const std::uint32_t triangle = edge.triangle;
        const auto number = static_cast<std::uint32_t>(seen_.size());
        last_seen_[triangle] = {cell_, number};
        seen_.push_back({triangle, {}, {source, source, source}});
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (k == edge.edge || !mesh_.across[triangle][k].exists()) continue;
            const double along =
                square_distance(source, frames_[triangle][k], frames_[triangle][corner_after(k)]);
            const double in_space = square_distance(position_, mesh_.corner(triangle, k),
                                                    mesh_.corner(triangle, corner_after(k)));
            const double square = std::max(along, in_space);
            if (square >= radius_ * radius_) continue;
            fronts_.push_back({square, number, k});
            std::push_heap(fronts_.begin(), fronts_.end());
        }
    }

    void hand_on(const Front& front) {
        Seen& here = seen_[front.seen];
        if (here.is_reached[front.edge]) return;
        here.is_reached[front.edge] = true;
        const TriangleEdge other = mesh_.across[here.triangle][front.edge];
        const Vector2d source =
            carried({here.triangle, front.edge}, other, here.from_edges[front.edge]);
        if (last_seen_[other.triangle].cell != cell_) enter(other, source);
        Seen& there = seen_[last_seen_[other.triangle].number];
        there.is_reached[other.edge] = true;
        there.from_edges[other.edge] = source;
    }

    /// Maps a point from the plane of one triangle to that of the other.
    Vector2d carried(TriangleEdge edge, TriangleEdge other, Vector2d point) const {
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

    const SurfaceMesh& mesh_;
    std::span<const FlatTriangle> frames_;
    double radius_;
    std::uint32_t cell_ = 0;
    Vector3d position_;
    std::vector<LastSeen> last_seen_;  ///< Per triangle.
    std::vector<Seen> seen_;
    std::vector<Front> fronts_;  ///< A heap; the nearest comes first.
};

}  // namespace

std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle) {
    std::array<double, 3> lengths;
    for (std::uint32_t k = 0; k < 3; ++k) {
        lengths[k] = length(mesh.corner(triangle, corner_after(k)) - mesh.corner(triangle, k));
    }
    return static_cast<std::uint32_t>(std::max_element(lengths.begin(), lengths.end()) -
                                      lengths.begin());
}

FlatTriangle longest_edge_frame(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const std::uint32_t k = longest_edge(mesh, triangle);
    const double size = length(mesh.corner(triangle, corner_after(k)) - mesh.corner(triangle, k));
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
        for (auto k = static_cast<std::size_t>(part.begin); k < static_cast<std::size_t>(part.end);
             ++k) {
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
