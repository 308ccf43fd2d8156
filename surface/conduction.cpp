// Compares each cell's sum of weights divided by its area with a limit, which is a constant or a
// quantile. Areas are relative to the mean area.
#include "surface/conduction.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace cascade {

namespace {

// A smaller area counts as this fraction of the mean area. Without this limit, the smallest cells
// would make steps very short.
constexpr double least_conducting_area = 1e-3;
// The limit for spread cells. It applies to the sum of a cell's weights, times the mean area,
// divided by the cell's area. In regular hexagons this is 3.46.
constexpr double most_weight = 7.5;
// The fraction of cells whose areas are increased, if cells are faces or points.
constexpr double tightest_part = 1e-3;

/// The largest limit c for which the sum of min(w, c) over all weights w is at most `sum`.
double cap_for(std::vector<double> weights, double sum) {
    std::sort(weights.begin(), weights.end());
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const double cap = sum / static_cast<double>(weights.size() - k);
        if (weights[k] > cap) return cap;
        sum -= weights[k];
    }
    return std::numeric_limits<double>::infinity();
}

class Loosening {
public:
    Loosening(const SurfaceCells& cells, double unit) : cells_(cells), made_{cells.areas, {}} {
        const double mean = mean_area();
        for (double& area : made_.areas)
            area = std::max(area, least_conducting_area * mean) / (unit * unit);
        for (const VoronoiEdge& edge : cells.edges)
            made_.flows.push_back(edge.distance > 0 ? edge.weight() : 0);
        add_up();
    }

    void widen_spread_cells() { widen(most_weight); }

    void loosen_tightest() {
        const double most = std::max(most_weight, usual_most());
        cap_flows(most / mean_area());
        add_up();
        widen(most);
    }

    Conduction take() && { return std::move(made_); }

private:
    std::size_t count() const { return made_.areas.size(); }
    double mean_area() const {
        return std::accumulate(made_.areas.begin(), made_.areas.end(), 0.0) /
               static_cast<double>(count());
    }
    std::span<const double> flows_of(std::size_t cell) const {
        const auto edges = cells_.edges_of(cell);
        const auto first = static_cast<std::size_t>(edges.data() - cells_.edges.data());
        return {made_.flows.data() + first, edges.size()};
    }
    void add_up() {
        sums_.assign(count(), 0);
        for (std::size_t cell = 0; cell < count(); ++cell) {
            for (const double flow : flows_of(cell)) sums_[cell] += flow;
        }
    }

    void widen(double most) {
        const double mean = mean_area();
        for (std::size_t cell = 0; cell < count(); ++cell)
            made_.areas[cell] = std::max(made_.areas[cell], sums_[cell] * mean / most);
    }

    /// The limit that all cells but the tightest fulfil. A cell is compared by the sum of its
    /// weights divided by its area, relative to the mean area.
    double usual_most() const {
        const double mean = mean_area();
        std::vector<double> relative;
        for (std::size_t cell = 0; cell < count(); ++cell)
            relative.push_back(sums_[cell] * mean / made_.areas[cell]);
        const auto tight =
            static_cast<std::ptrdiff_t>(tightest_part * static_cast<double>(count()));
        const auto limit = relative.end() - 1 - tight;
        std::nth_element(relative.begin(), limit, relative.end());
        return *limit;
    }

    /// Reduces the flows of each cell so that their sum is at most `most` times the cell's area, or
    /// at most `most_weight` if that is larger.
    void cap_flows(double most) {
        std::vector<double> caps(count(), std::numeric_limits<double>::infinity());
        for (std::size_t cell = 0; cell < count(); ++cell) {
            const double sum = std::max(most * made_.areas[cell], most_weight);
            const auto flows = flows_of(cell);
            if (sums_[cell] > sum) caps[cell] = cap_for({flows.begin(), flows.end()}, sum);
        }
        std::size_t edge = 0;
        for (std::size_t cell = 0; cell < count(); ++cell) {
            for (; edge < cells_.ends[cell]; ++edge) {
                made_.flows[edge] =
                    std::min({made_.flows[edge], caps[cell], caps[cells_.edges[edge].neighbour]});
            }
        }
    }

    const SurfaceCells& cells_;
    Conduction made_;
    std::vector<double> sums_;  ///< The sums of flows, by cell.
};

}  // namespace

Conduction conduction_of(const SurfaceCells& cells, bool are_spread, double unit) {
    Loosening loosening(cells, unit);
    if (are_spread) {
        loosening.widen_spread_cells();
    } else {
        loosening.loosen_tightest();
    }
    return std::move(loosening).take();
}

}  // namespace cascade
