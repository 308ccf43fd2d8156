// Unfolds the surface around the position with a growing radius until the nearest cell is certain.
#include "surface/cell_finder.h"

#include "surface/relax.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace cascade {

namespace {

/// The nearest cell. If several cells are equally near, the cell with the lowest index.
struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t cell = CellFinder::nothing;

    void see(double other, std::uint32_t number) {
        if (other < distance || (other == distance && number < cell)) *this = {other, number};
    }
};

}  // namespace

CellFinder::CellFinder(const SurfaceMesh& mesh, std::span<const SurfacePlace> cells)
    : mesh_(mesh), cells_(cells), order_(cells.size()), shapes_(mesh), unfolding_(mesh, shapes_) {
    const MeshFacts facts = facts_of(mesh);
    reach_ = repulsion_radius(facts.area, std::max<std::size_t>(order_.size(), 1));
    // No path in an unfolded patch is longer than all edges together.
    whole_ = 3 * length(facts.high - facts.low) * static_cast<double>(facts.triangles);
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return cells[a].triangle < cells[b].triangle;
    });
}

std::span<const std::uint32_t> CellFinder::on(std::uint32_t triangle) const {
    const auto of = [&](std::uint32_t cell) { return cells_[cell].triangle; };
    const auto first = std::partition_point(order_.begin(), order_.end(), [&](std::uint32_t cell) {
        return of(cell) < triangle;
    });
    const auto last = std::partition_point(first, order_.end(), [&](std::uint32_t cell) {
        return of(cell) <= triangle;
    });
    return {first, last};
}

std::uint32_t CellFinder::at(const SurfacePlace& place) {
    Nearest nearest;
    for (double reach = reach_;; reach *= 2) {
        for (const Unfolding::Piece& piece : unfolding_.around(place, reach)) {
            for (const std::uint32_t cell : on(piece.triangle)) {
                nearest.see(length(position_of(piece.flat, cells_[cell].weights)), cell);
            }
        }
        // A cell farther away than the reach is not certain to be the nearest, because the patch
        // may lack a nearer cell.
        if (nearest.distance <= reach) return nearest.cell;
        if (!(reach < whole_)) break;
    }
    if (nearest.cell != nothing) return nearest.cell;
    const Vector3d position = position_of(mesh_, place);
    for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
        nearest.see(length(position_of(mesh_, cells_[cell]) - position), cell);
    }
    return nearest.cell;
}

}  // namespace cascade
