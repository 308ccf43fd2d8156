// Looks for each neighbour among the unfolded triangles; both sides of a Voronoi edge then get the
// same turn.
#include "surface/cell_unfolding.h"

#include "surface/tangent_frame.h"
#include "surface/unfolding.h"

#include <algorithm>

namespace cascade {

namespace {

double angle_of(Vector2d v) { return std::atan2(v.y, v.x); }

/// Unfolds around cells, one a thread.
class NeighbourFinder {
public:
    NeighbourFinder(const SurfaceMesh& mesh, const EdgeShapes& shapes, const SurfaceCells& cells)
        : mesh_(mesh), cells_(cells), unfolding_(mesh, shapes) {}

    void find(std::size_t cell, std::span<UnfoldedNeighbour> found) {
        const auto edges = cells_.edges_of(cell);
        double farthest = 0;
        for (const VoronoiEdge& edge : edges) farthest = std::max(farthest, edge.distance);
        // A Voronoi edge's distance is the mean of what its two cells see: one of them may see
        // more.
        unfolding_.around(cells_.places[cell], 1.5 * farthest);
        for (std::size_t k = 0; k < edges.size(); ++k) found[k] = neighbour(cell, edges[k]);
    }

private:
    UnfoldedNeighbour neighbour(std::size_t cell, const VoronoiEdge& edge) const {
        const SurfacePlace& other = cells_.places[edge.neighbour];
        if (const FlatTriangle* flat = unfolding_.flat_of(other.triangle)) {
            return {position_of(*flat, other.weights), turn_of(*flat, other.triangle)};
        }
        // Out of reach: along the straight line in space.
        const SurfacePlace& here = cells_.places[cell];
        const TangentFrame frame = tangent_frame(mesh_, here.triangle);
        const Vector2d towards =
            frame.in_plane(position_of(mesh_, other) - position_of(mesh_, here));
        const double size = length(towards);
        const Vector2d place = size > 0 ? towards * (edge.distance / size) : Vector2d{};
        const TangentFrame there = tangent_frame(mesh_, other.triangle);
        return {place, angle_of(frame.in_plane(there.along))};
    }

    /// From the longest edge, which rounding turns least.
    double turn_of(const FlatTriangle& flat, std::uint32_t triangle) const {
        const FlatTriangle own = own_frame(mesh_, triangle);
        std::uint32_t longest = 0;
        double size = -1;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const double edge = length(own[(k + 1) % 3] - own[k]);
            if (edge > size) {
                size = edge;
                longest = k;
            }
        }
        const std::uint32_t next = (longest + 1) % 3;
        return angle_of(flat[next] - flat[longest]) - angle_of(own[next] - own[longest]);
    }

    const SurfaceMesh& mesh_;
    const SurfaceCells& cells_;
    Unfolding unfolding_;
};

/// Takes the turn of a Voronoi edge from its cell of the lower number.
void match_turns(const SurfaceCells& cells, std::vector<UnfoldedNeighbour>& found) {
    std::size_t at = 0;
    for (std::uint32_t cell = 0; cell < cells.places.size(); ++cell) {
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            UnfoldedNeighbour& here = found[at++];
            if (edge.neighbour > cell) continue;
            const auto back = cells.edges_of(edge.neighbour);
            const auto same = std::lower_bound(back.begin(), back.end(), cell,
                                               [](const VoronoiEdge& a, std::uint32_t number) {
                                                   return a.neighbour < number;
                                               });
            if (same == back.end() || same->neighbour != cell) continue;
            here.turn = -found[static_cast<std::size_t>(&*same - cells.edges.data())].turn;
        }
    }
}

}  // namespace

std::vector<UnfoldedNeighbour> unfold_neighbours(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                                 Team& team, const std::atomic<bool>& cancel) {
    std::vector<UnfoldedNeighbour> found(cells.edges.size());
    const EdgeShapes shapes(mesh);
    team.run([&](int thread) {
        const RowRange part =
            split_rows(static_cast<std::int64_t>(cells.places.size()), thread, team.size());
        NeighbourFinder finder(mesh, shapes, cells);
        for (std::int64_t k = part.begin; k < part.end && !cancel; ++k) {
            const auto cell = static_cast<std::size_t>(k);
            const auto edges = cells.edges_of(cell);
            const auto first = static_cast<std::size_t>(edges.data() - cells.edges.data());
            finder.find(cell, std::span(found).subspan(first, edges.size()));
        }
    });
    if (!cancel) match_turns(cells, found);
    return found;
}

}  // namespace cascade
