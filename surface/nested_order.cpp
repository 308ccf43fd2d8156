// Farthest-first traversal. Taking a cell shortens the distances of the cells around it. The search
// for these cells ends at cells that are nearer to another taken cell, so searches become smaller
// and smaller.
#include "surface/nested_order.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace cascade {

namespace {

/// A cell at a distance. If distances are equal, the cell with the lowest index is first.
using Distance = std::pair<double, std::int64_t>;

class FarthestFirst {
public:
    explicit FarthestFirst(const SurfaceCells& cells)
        : cells_(cells), distances_(cells.places.size(), std::numeric_limits<double>::infinity()) {
        for (std::size_t cell = 0; cell < distances_.size(); ++cell) note(cell);
    }

    std::vector<std::uint32_t> order() {
        std::vector<std::uint32_t> order;
        while (!farthest_.empty()) {
            const auto [distance, negative] = farthest_.top();
            farthest_.pop();
            const auto cell = static_cast<std::size_t>(-negative);
            // A shorter distance has replaced this entry.
            if (distance != distances_[cell]) continue;
            order.push_back(static_cast<std::uint32_t>(cell));
            take(cell);
        }
        return order;
    }

private:
    void note(std::size_t cell) {
        farthest_.push({distances_[cell], -static_cast<std::int64_t>(cell)});
    }

    void take(std::size_t taken) {
        std::priority_queue<Distance, std::vector<Distance>, std::greater<>> near;
        near.push({0, static_cast<std::int64_t>(taken)});
        distances_[taken] = 0;
        while (!near.empty()) {
            const auto [distance, number] = near.top();
            near.pop();
            const auto cell = static_cast<std::size_t>(number);
            if (distance > distances_[cell]) continue;
            for (const VoronoiEdge& edge : cells_.edges_of(cell)) {
                const double along = distance + edge.distance;
                if (!(along < distances_[edge.neighbour])) continue;
                distances_[edge.neighbour] = along;
                near.push({along, edge.neighbour});
                note(edge.neighbour);
            }
        }
    }

    const SurfaceCells& cells_;
    /// The distance of each cell to the nearest cell taken so far.
    std::vector<double> distances_;
    std::priority_queue<Distance> farthest_;  ///< Cells not taken yet. Some entries are outdated.
};

}  // namespace

std::vector<std::uint32_t> nested_order(const SurfaceCells& cells) {
    return FarthestFirst(cells).order();
}

}  // namespace cascade
