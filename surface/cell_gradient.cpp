// A weighted least-squares fit to the unfolded neighbours, by the pseudo-inverse of a 2 × 2 matrix.
#include "surface/cell_gradient.h"

#include "surface/cell_unfolding.h"
#include "surface/tangent_frame.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Neighbours are collinear if the ratio of the (squared) spreads across and along a line is below
/// this.
constexpr double on_a_line = 1e-3;

/// Neighbours nearer than this fraction of the cell's extent coincide with the cell.
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

/// The inverse; for rank 1 the pseudo-inverse; else 0.
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

/// Writes the weights of one cell.
void fit(const TangentFrame& frame, std::span<const VoronoiEdge> edges,
         std::span<const UnfoldedNeighbour> neighbours, std::span<Vector3d> weights) {
    // Distances are relative to the longest, so that the scale of a model does not matter.
    double size = 0, longest = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        size = std::max(size, length(neighbours[k].place));
        longest = std::max(longest, edges[k].length);
    }
    if (!(size > same_place * longest) || !(longest > 0)) return;
    const auto place = [&](std::size_t k) { return neighbours[k].place * (1 / size); };
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

}  // namespace

std::vector<Vector3d> cell_gradient_weights(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                            Team& team, const std::atomic<bool>& cancel) {
    const std::vector<UnfoldedNeighbour> neighbours = unfold_neighbours(mesh, cells, team, cancel);
    std::vector<Vector3d> weights(cells.edges.size());
    for (std::size_t cell = 0; cell < cells.places.size() && !cancel; ++cell) {
        const auto edges = cells.edges_of(cell);
        const auto first = static_cast<std::size_t>(edges.data() - cells.edges.data());
        fit(tangent_frame(mesh, cells.places[cell].triangle), edges,
            std::span(neighbours).subspan(first, edges.size()),
            std::span(weights).subspan(first, edges.size()));
    }
    return weights;
}

std::vector<Vector3d> cell_gradients(const SurfaceCells& cells, std::span<const Vector3d> weights,
                                     std::span<const double> values) {
    std::vector<Vector3d> gradients(cells.places.size());
    std::size_t at = 0;
    for (std::size_t cell = 0; cell < gradients.size(); ++cell) {
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            gradients[cell] =
                gradients[cell] + weights[at++] * (values[edge.neighbour] - values[cell]);
        }
    }
    return gradients;
}

}  // namespace cascade
