#include "surface/blur_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cascade {

namespace {

/// Walls longer than this times the distance of their cells would make steps short: cells that
/// nearly coincide.
constexpr double most_flow = 4;
constexpr double least_area = 0.2;  ///< Of the average.
constexpr double steps = 2;         ///< Two rough steps make a smoother Gaussian than one.

/// What flows between cells, in units of the average area.
struct Flows {
    std::vector<float> inverse_areas;
    std::vector<float> walls;        ///< Length over distance, as in SurfaceCells::walls.
    double fastest = 0;              ///< No wave decays faster than this.
};

Flows flows_of(const SurfaceCells& cells) {
    Flows flows;
    const double average = cell_spacing(cells) * cell_spacing(cells);
    for (const CellWall& wall : cells.walls) {
        const double flow = wall.distance > 0 ? wall.length / wall.distance : most_flow;
        flows.walls.push_back(static_cast<float>(std::min(flow, most_flow)));
    }
    std::size_t wall = 0;
    for (std::size_t cell = 0; cell < cells.ends.size(); ++cell) {
        const double area = std::max(least_area, cells.areas[cell] / average);
        flows.inverse_areas.push_back(static_cast<float>(1 / area));
        double sum = 0;
        for (; wall < cells.ends[cell]; ++wall) sum += static_cast<double>(flows.walls[wall]);
        flows.fastest = std::max(flows.fastest, 2 * sum / area);  // Gershgorin's circles.
    }
    return flows;
}

/// The stages of one step of length `time`.
class Step {
public:
    Step(const SurfaceCells& cells, const Flows& flows, int channels, double time)
        : cells_(cells), flows_(flows), channels_(static_cast<std::size_t>(channels)) {
        const double ratio = time * flows.fastest;
        stages_ = 1;
        while (static_cast<double>(stages_) * (stages_ + 1) < ratio) ++stages_;
        scale_ = 2 * time / (static_cast<double>(stages_) * (stages_ + 1));
    }

    void run(std::vector<float>& values, Team& team) {
        std::vector<float> before = values, next(values.size());
        sweep(1, 0, values, before, next, team);
        values.swap(next);
        for (int j = 2; j <= stages_; ++j) {
            sweep((2.0 * j - 1) / j, (1.0 - j) / j, values, before, next, team);
            before.swap(values);
            values.swap(next);
        }
    }

private:
    /// next = mu values + nu before + mu scale (what flows into values).
    void sweep(double mu, double nu, const std::vector<float>& values,
               const std::vector<float>& before, std::vector<float>& next, Team& team) const {
        const auto a = static_cast<float>(mu), b = static_cast<float>(nu);
        const auto c = static_cast<float>(mu * scale_);
        team.run([&](int thread) {
            const RowRange part =
                split_rows(static_cast<std::int64_t>(cells_.ends.size()), thread, team.size());
            for (auto cell = static_cast<std::size_t>(part.begin);
                 cell < static_cast<std::size_t>(part.end); ++cell) {
                const float* own = &values[cell * channels_];
                float* sums = &next[cell * channels_];
                std::fill(sums, sums + channels_, 0.0F);
                const std::size_t first = cell == 0 ? 0 : cells_.ends[cell - 1];
                for (std::size_t wall = first; wall < cells_.ends[cell]; ++wall) {
                    const float* other = &values[cells_.walls[wall].neighbour * channels_];
                    const float flow = flows_.walls[wall];
                    for (std::size_t k = 0; k < channels_; ++k) sums[k] += flow * (other[k] - own[k]);
                }
                const float rate = c * flows_.inverse_areas[cell];
                for (std::size_t k = 0; k < channels_; ++k) {
                    sums[k] = a * own[k] + b * before[cell * channels_ + k] + rate * sums[k];
                }
            }
        });
    }

    const SurfaceCells& cells_;
    const Flows& flows_;
    std::size_t channels_;
    int stages_ = 1;
    double scale_ = 0;
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
    Step step(cells, flows, channels, sigma * sigma / 2 / steps);
    for (int k = 0; k < steps; ++k) step.run(values, team);
}

}  // namespace cascade
