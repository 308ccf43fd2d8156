// A weighted least-squares fit to the unfolded neighbours, by the pseudo-inverse of a 2 × 2 matrix.
#include "surface/cell_gradient.h"

#include "surface/tangent_frame.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Neighbours count as collinear if their squared spread across a line, divided by their squared
/// spread along it, is below this.
constexpr double on_a_line = 1e-3;

/// A neighbour nearer than this fraction of the cell's extent counts as being at the cell's
/// position.
constexpr double same_place = 1e-9;

/// A symmetric 2 × 2 matrix [xx, xy; xy, yy].
struct Spread {
    double xx = 0, xy = 0, yy = 0;

    void add(Vector2d v, double weight) {
        xx += weight * v.x * v.x;
        xy += weight * v.x * v.y;
        yy += weight * v.y * v.y;
    }
};

/// The inverse for rank 2, the pseudo-inverse for rank 1, else 0.
Spread pseudo_inverse(const Spread& m) {
    const double half = (m.xx + m.yy) / 2, apart = std::hypot((m.xx - m.yy) / 2, m.xy);
    const double large = half + apart;
    const double determinant = m.xx * m.yy - m.xy * m.xy;
    if (!(large > 0)) return {};
    if (determinant > on_a_line * large * large) {
        return {m.yy / determinant, -m.xy / determinant, m.xx / determinant};
    }
    // The direction of the larger eigenvalue: half the angle of (xx − yy, 2 xy).
    const double angle = std::atan2(2 * m.xy, m.xx - m.yy) / 2;
    const Vector2d along = {std::cos(angle), std::sin(angle)};
    return {along.x * along.x / large, along.x * along.y / large, along.y * along.y / large};
}

/// Unfolds the surface around cells. One object per thread.
class NeighbourFinder {
public:
    NeighbourFinder(const SurfaceMesh& mesh, const EdgeShapes& shapes, const SurfaceCells& cells)
        : mesh_(mesh), cells_(cells), unfolding_(mesh, shapes) {}

    /// The positions of a cell's neighbours in its triangle's plane, valid until the next call.
    std::span<const Vector2d> find(std::size_t cell) {
        const auto edges = cells_.edges_of(cell);
        double farthest = 0;
        for (const VoronoiEdge& edge : edges) farthest = std::max(farthest, edge.distance);
        // The distance of a Voronoi edge is the mean of the distances measured from both cells. The
        // distance measured from this cell may be longer, hence the factor.
        unfolding_.around(cells_.places[cell], 1.5 * farthest);
        found_.clear();
        for (const VoronoiEdge& edge : edges) found_.push_back(neighbour(cell, edge));
        return found_;
    }

private:
    Vector2d neighbour(std::size_t cell, const VoronoiEdge& edge) const {
        const SurfacePlace& other = cells_.places[edge.neighbour];
        if (const FlatTriangle* flat = unfolding_.flat_of(other.triangle)) {
            return position_of(*flat, other.weights);
        }
        // The neighbour is out of reach, so the straight line in space is used.
        const SurfacePlace& here = cells_.places[cell];
        const Vector2d towards =
            tangent_frame(mesh_, here.triangle)
                .in_plane(position_of(mesh_, other) - position_of(mesh_, here));
        const double size = length(towards);
        return size > 0 ? towards * (edge.distance / size) : Vector2d{};
    }

    const SurfaceMesh& mesh_;
    const SurfaceCells& cells_;
    Unfolding unfolding_;
    std::vector<Vector2d> found_;
};

/// Writes the weights of one cell.
void fit(const TangentFrame& frame, std::span<const VoronoiEdge> edges,
         std::span<const Vector2d> neighbours, std::span<Vector3d> weights) {
    // Distances are relative to the longest, so that the scale of a model does not matter.
    double size = 0, longest = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        size = std::max(size, length(neighbours[k]));
        longest = std::max(longest, edges[k].length);
    }
    if (!(size > same_place * longest) || !(longest > 0)) return;
    const auto place = [&](std::size_t k) { return neighbours[k] * (1 / size); };
    const auto importance = [&](std::size_t k) {
        const double distance = length(place(k));
        return distance > same_place ? edges[k].length / longest / distance : 0;
    };
    Spread spread;
    for (std::size_t k = 0; k < edges.size(); ++k) spread.add(place(k), importance(k));
    const Spread inverse = pseudo_inverse(spread);
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const Vector2d v = place(k) * (importance(k) / size);
        weights[k] = frame.in_space(
            {inverse.xx * v.x + inverse.xy * v.y, inverse.xy * v.x + inverse.yy * v.y});
    }
}

/// Calls `use(frame, edges, neighbours, first)` for each cell, in any order. `first` is the number
/// of the cell's first edge.
template <typename Use>
void for_each_cell(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team,
                   const std::atomic<bool>& cancel, const Use& use) {
    const EdgeShapes shapes(mesh);
    team.run([&](int thread) {
        const RowRange part =
            split_rows(static_cast<std::int64_t>(cells.places.size()), thread, team.size());
        NeighbourFinder finder(mesh, shapes, cells);
        for (std::int64_t k = part.begin; k < part.end && !cancel; ++k) {
            const auto cell = static_cast<std::size_t>(k);
            const auto edges = cells.edges_of(cell);
            use(tangent_frame(mesh, cells.places[cell].triangle), edges, finder.find(cell),
                static_cast<std::size_t>(edges.data() - cells.edges.data()));
        }
    });
}

}  // namespace

std::vector<Vector3d> cell_gradient_weights(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                            Team& team, const std::atomic<bool>& cancel) {
    std::vector<Vector3d> weights(cells.edges.size());
    for_each_cell(mesh, cells, team, cancel,
                  [&](const TangentFrame& frame, std::span<const VoronoiEdge> edges,
                      std::span<const Vector2d> neighbours, std::size_t first) {
                      fit(frame, edges, neighbours,
                          std::span(weights).subspan(first, edges.size()));
                  });
    return weights;
}

std::vector<Vector3d> unfolded_neighbours(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                          Team& team, const std::atomic<bool>& cancel) {
    std::vector<Vector3d> positions(cells.edges.size());
    for_each_cell(mesh, cells, team, cancel,
                  [&](const TangentFrame& frame, std::span<const VoronoiEdge>,
                      std::span<const Vector2d> neighbours, std::size_t first) {
                      for (const Vector2d& neighbour : neighbours)
                          positions[first++] = frame.in_space(neighbour);
                  });
    return positions;
}

}  // namespace cascade
