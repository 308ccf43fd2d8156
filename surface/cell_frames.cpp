// Derives frames from the upward axis. Evenness is a sum over the links of each cell.
#include "surface/cell_frames.h"

#include "surface/cell_gradient.h"
#include "surface/direction_field.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

// The largest ratio of the eigenvalues of M at which gradients certainly have a component across
// the line of the neighbours (surface/cell_gradient.h). A margin is included.
constexpr double most_ratio = 500;

/// Sums over the links of a cell, in its plane.
struct Shape {
    double xx = 0, xy = 0, yy = 0;  ///< The matrix M.

    void add(Vector2d r, double weight) {
        xx += weight * r.x * r.x;
        xy += weight * r.x * r.y;
        yy += weight * r.y * r.y;
    }
    double half() const { return (xx + yy) / 2; }
    double apart() const { return std::hypot((xx - yy) / 2, xy); }
    /// The squared length of `v` in the metric of the inverse of M.
    double square_by_inverse(Vector2d v) const {
        const double determinant = xx * yy - xy * xy;
        return (yy * v.x * v.x - 2 * xy * v.x * v.y + xx * v.y * v.y) / determinant;
    }
};

/// A neighbour: its position in the cell's plane, the line to it, its weight in the fit of
/// gradients, and the weight of its link.
struct Neighbour {
    Vector2d unfolded, line;
    double in_fit = 0, flow = 0;
};

double evenness_of(const std::vector<Neighbour>& neighbours) {
    Shape shape;
    for (const Neighbour& each : neighbours) shape.add(each.unfolded, each.in_fit);
    const double large = shape.half() + shape.apart(), small = shape.half() - shape.apart();
    if (!(large > 0) || !(small * most_ratio > large)) return 0;
    double mismatch = 0;
    for (const Neighbour& each : neighbours) {
        const Vector2d apart = each.line * each.flow - each.unfolded * each.in_fit;
        if (each.flow > 0) mismatch += shape.square_by_inverse(apart) / each.flow;
    }
    const double round = std::sqrt(large * small) / shape.half();  // √(1 − σ²)
    return 1 / (1 / round + 2 * std::sqrt(large / small * mismatch));
}

}  // namespace

CellFrames cell_frames(const SurfaceMesh& mesh, const SurfaceCells& cells) {
    const TangentPlanes planes = planes_of_triangles(mesh);
    const std::vector<Vector3d> up = axis_directions(planes, {0, 1, 0}, DirectionKind::arrows);
    CellFrames frames;
    for (const SurfacePlace& place : cells.places) {
        const Vector3d down = up[place.triangle] * -1.0;
        frames.right.push_back(cross(planes.frames[place.triangle].normal, down));
        frames.down.push_back(down);
    }
    return frames;
}

std::vector<double> evenness_of_cells(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                      const CellFrames& frames, const Conduction& conduction,
                                      Team& team, const std::atomic<bool>& cancel) {
    const std::vector<Vector3d> unfolded = unfolded_neighbours(mesh, cells, team, cancel);
    std::vector<Vector3d> positions;
    for (const SurfacePlace& place : cells.places) positions.push_back(position_of(mesh, place));
    std::vector<double> evenness;
    std::vector<Neighbour> neighbours;
    for (std::size_t cell = 0, edge = 0; cell < positions.size(); ++cell) {
        const auto in_plane = [&](Vector3d v) {
            return Vector2d{dot(frames.right[cell], v), dot(frames.down[cell], v)};
        };
        neighbours.clear();
        for (; edge < cells.ends[cell]; ++edge) {
            const VoronoiEdge& link = cells.edges[edge];
            Neighbour each;
            each.unfolded = in_plane(unfolded[edge]);
            each.line = in_plane(positions[link.neighbour] - positions[cell]);
            const double distance = length(each.unfolded);
            each.in_fit = distance > 0 ? link.length / distance : 0;
            each.flow = conduction.flows[edge];
            neighbours.push_back(each);
        }
        evenness.push_back(evenness_of(neighbours));
    }
    return evenness;
}

}  // namespace cascade
