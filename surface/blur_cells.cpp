// Computes the exponential of the diffusion operator as a series of Chebyshev polynomials. This
// applies the operator far less often than explicit steps would.
#include "surface/blur_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cascade {

namespace {

/// The limit for a Voronoi edge's length divided by the distance between its cells. Without this
/// limit, cells near each other would require many applications of the operator.
constexpr double most_flow = 4;
/// The least area of a cell, as a fraction of the average.
constexpr double least_blurred_area = 0.2;
constexpr double precision = 1e-4;  ///< Limits the sum of the omitted terms of the series.

/// The coefficients of the flow between cells, in units of the average area.
struct Flows {
    std::vector<float> inverse_areas;
    std::vector<float> edges;  ///< Length divided by distance, in the order of SurfaceCells::edges.
    double fastest = 0;        ///< An upper bound of the decay rates of all waves.
};

Flows flows_of(const SurfaceCells& cells) {
    Flows flows;
    const double average = cell_spacing(cells) * cell_spacing(cells);
    for (const VoronoiEdge& edge : cells.edges) {
        const double flow = edge.distance > 0 ? edge.length / edge.distance : most_flow;
        flows.edges.push_back(static_cast<float>(std::min(flow, most_flow)));
    }
    std::size_t edge = 0;
    for (std::size_t cell = 0; cell < cells.ends.size(); ++cell) {
        const double area = std::max(least_blurred_area, cells.areas[cell] / average);
        flows.inverse_areas.push_back(static_cast<float>(1 / area));
        double sum = 0;
        for (; edge < cells.ends[cell]; ++edge) sum += static_cast<double>(flows.edges[edge]);
        flows.fastest = std::max(flows.fastest, 2 * sum / area);  // By Gershgorin circles.
    }
    return flows;
}

/// The coefficients of exp(z (x − 1)) in Chebyshev polynomials of x, −1 … 1, scaled to the sum 1.
/// They are exp(−z) times the modified Bessel functions I₀(z), 2 I₁(z), 2 I₂(z), … (M. Abramowitz
/// and I. Stegun, "Handbook of Mathematical Functions", 9.6.34), truncated at `precision`. The
/// functions are computed backwards by I_{k−1} = I_{k+1} + (2 k / z) I_k (Miller's algorithm).
std::vector<float> coefficients(double z) {
    const auto last = static_cast<std::size_t>(std::sqrt(40 * z)) + 10;
    std::vector<double> found(last + 2);
    found[last] = 1;
    double sum = 2;
    for (std::size_t k = last; k > 0; --k) {
        found[k - 1] = found[k + 1] + 2 * static_cast<double>(k) / z * found[k];
        sum += (k == 1 ? 1 : 2) * found[k - 1];
        if (sum < 1e200) continue;
        for (std::size_t j = k - 1; j <= last; ++j) found[j] *= 1e-200;
        sum *= 1e-200;
    }
    std::size_t degree = 0;
    double left = sum - found[0];
    while (left > precision * sum && degree < last) left -= 2 * found[++degree];
    std::vector<float> result;
    for (std::size_t k = 0; k <= degree; ++k) {
        result.push_back(static_cast<float>((k == 0 ? 1 : 2) * found[k] / (sum - left)));
    }
    return result;
}

/// Applies exp(time × flows). B = 1 + 2 flows / fastest has eigenvalues in −1 … 1. With z = time ×
/// fastest / 2, the operator is exp(z (B − 1)), a sum of T_k(B), where T_{k+1} = 2 B T_k − T_{k−1}.
class Diffusion {
public:
    Diffusion(const SurfaceCells& cells, const Flows& flows, int channels)
        : cells_(cells), flows_(flows), channels_(static_cast<std::size_t>(channels)) {}

    void run(double time, std::vector<float>& values, Team& team) {
        const std::vector<float> terms = coefficients(time * flows_.fastest / 2);
        std::vector<float> current = values, before = values, next(values.size());
        for (float& value : values) value *= terms[0];
        for (std::size_t k = 1; k < terms.size(); ++k) {
            sweep(k == 1 ? 1 : 2, k == 1 ? 0 : -1, terms[k], current, before, next, values, team);
            before.swap(current);
            current.swap(next);
        }
    }

private:
    /// Sets `next` to a B `current` + b `before`, and adds `term` times `next` to `sum`.
    void sweep(float a, float b, float term, const std::vector<float>& current,
               const std::vector<float>& before, std::vector<float>& next, std::vector<float>& sum,
               Team& team) const {
        const auto scale = static_cast<float>(2 / flows_.fastest);
        team.run([&](int thread) {
            const RowRange part =
                split_rows(static_cast<std::int64_t>(cells_.ends.size()), thread, team.size());
            for (auto cell = static_cast<std::size_t>(part.begin);
                 cell < static_cast<std::size_t>(part.end); ++cell) {
                const std::size_t at = cell * channels_;
                const float* own = &current[at];
                float* gained = &next[at];
                std::fill(gained, gained + channels_, 0.0F);
                const std::size_t first = cell == 0 ? 0 : cells_.ends[cell - 1];
                for (std::size_t edge = first; edge < cells_.ends[cell]; ++edge) {
                    const float* other = &current[cells_.edges[edge].neighbour * channels_];
                    const float flow = flows_.edges[edge];
                    for (std::size_t k = 0; k < channels_; ++k)
                        gained[k] += flow * (other[k] - own[k]);
                }
                const float rate = scale * flows_.inverse_areas[cell];
                for (std::size_t k = 0; k < channels_; ++k) {
                    gained[k] = a * (own[k] + rate * gained[k]) + b * before[at + k];
                    sum[at + k] += term * gained[k];
                }
            }
        });
    }

    const SurfaceCells& cells_;
    const Flows& flows_;
    std::size_t channels_;
};

}  // namespace

double cell_spacing(const SurfaceCells& cells) {
    const double area = std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0);
    return std::sqrt(area / static_cast<double>(cells.areas.size()));
}

void blur_cells(const SurfaceCells& cells, double sigma, int channels, std::vector<float>& values,
                Team& team) {
    if (values.empty() || !(sigma > 0)) return;
    const Flows flows = flows_of(cells);
    if (!(flows.fastest > 0)) return;
    const double time = sigma * sigma / 2;
    if (time * flows.fastest < precision) return;
    Diffusion(cells, flows, channels).run(time, values, team);
}

}  // namespace cascade
