// Surfaces for tests of cells, and checks for all cells.
#pragma once

#include "surface/surface_cells.h"
#include "unit/surface/even_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cascade::test {

/// The standard deviation divided by the mean of the distance from a place to the nearest other
/// one.
inline double unevenness(const SurfaceMesh& mesh, const std::vector<SurfacePlace>& places) {
    double sum = 0, squares = 0;
    for (std::size_t a = 0; a < places.size(); ++a) {
        double nearest = 1e9;
        for (std::size_t b = 0; b < places.size(); ++b) {
            if (a == b) continue;
            nearest = std::min(nearest,
                               length(position_of(mesh, places[a]) - position_of(mesh, places[b])));
        }
        sum += nearest;
        squares += nearest * nearest;
    }
    const auto count = static_cast<double>(places.size());
    return std::sqrt(squares / count - sum / count * (sum / count)) / (sum / count);
}

/// The discrete Laplacian of c in each cell i: (Σ (c_j − c_i) length / distance) / area.
inline std::vector<double> laplacian(const SurfaceCells& cells, const std::vector<double>& c) {
    std::vector<double> result;
    for (std::size_t i = 0; i < c.size(); ++i) {
        double sum = 0;
        for (const VoronoiEdge& edge : cells.edges_of(i)) {
            sum += (c[edge.neighbour] - c[i]) * edge.weight();
        }
        result.push_back(sum / cells.areas[i]);
    }
    return result;
}

/// The rate at which f decays by diffusion: −⟨f, L f⟩ / ⟨f, f⟩, with areas as weights.
inline double decay_rate(const SurfaceCells& cells, const std::vector<double>& f) {
    const std::vector<double> lap = laplacian(cells, f);
    double above = 0, below = 0;
    for (std::size_t k = 0; k < f.size(); ++k) {
        above -= f[k] * lap[k] * cells.areas[k];
        below += f[k] * f[k] * cells.areas[k];
    }
    return above / below;
}

/// The largest relative error of the rates l (l + 1) at which the harmonics of degree l = 1, 2 and
/// 3 decay.
inline double harmonics_error(const SurfaceMesh& unit_sphere, const SurfaceCells& cells) {
    double worst = 0;
    for (int l = 1; l <= 3; ++l) {
        std::vector<double> f;
        for (const SurfacePlace& place : cells.places) {
            const double z = unit(position_of(unit_sphere, place)).z;
            f.push_back(l == 1 ? z : l == 2 ? 1.5 * z * z - 0.5 : 2.5 * z * z * z - 1.5 * z);
        }
        worst = std::max(worst, std::abs(decay_rate(cells, f) / (l * (l + 1)) - 1));
    }
    return worst;
}

inline void expect_areas_sum_to(const SurfaceMesh& mesh, const SurfaceCells& cells) {
    double sum = cells.bare_area;
    for (const double area : cells.areas) {
        EXPECT_GE(area, 0);
        sum += area;
    }
    EXPECT_NEAR(sum / mesh.total_area(), 1, 1e-9);
}

inline void expect_symmetric_edges(const SurfaceCells& cells) {
    ASSERT_EQ(cells.ends.size(), cells.places.size());
    ASSERT_EQ(cells.ends.empty() ? 0 : cells.ends.back(), cells.edges.size());
    for (std::uint32_t i = 0; i < cells.places.size(); ++i) {
        for (const VoronoiEdge& edge : cells.edges_of(i)) {
            EXPECT_NE(edge.neighbour, i);
            EXPECT_GT(edge.length, 0);
            EXPECT_GT(edge.distance, 0);
            EXPECT_TRUE(std::isfinite(edge.weight()));
            const auto others = cells.edges_of(edge.neighbour);
            EXPECT_EQ(std::count_if(others.begin(), others.end(),
                                    [&](const VoronoiEdge& back) {
                                        return back.neighbour == i && back.length == edge.length &&
                                               back.distance == edge.distance;
                                    }),
                      1);
        }
    }
}

/// The standard deviation divided by the mean.
inline double relative_deviation(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double value : values) {
        sum += value;
        squares += value * value;
    }
    const auto count = static_cast<double>(values.size());
    return std::sqrt(squares / count - sum / count * (sum / count)) / (sum / count);
}

/// The number of connected parts of the graph whose nodes are cells and whose edges are Voronoi
/// edges.
inline std::size_t parts_of(const SurfaceCells& cells) {
    std::vector<bool> seen(cells.places.size());
    std::size_t parts = 0;
    for (std::uint32_t start = 0; start < seen.size(); ++start) {
        if (seen[start]) continue;
        ++parts;
        std::vector<std::uint32_t> waiting = {start};
        seen[start] = true;
        while (!waiting.empty()) {
            const std::uint32_t cell = waiting.back();
            waiting.pop_back();
            for (const VoronoiEdge& edge : cells.edges_of(cell)) {
                if (seen[edge.neighbour]) continue;
                seen[edge.neighbour] = true;
                waiting.push_back(edge.neighbour);
            }
        }
    }
    return parts;
}

}  // namespace cascade::test
