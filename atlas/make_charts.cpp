// Charts are independent of each other, and so are joins of pairs that have no chart in common:
// threads take one after the other.
#include "atlas/make_charts.h"

#include "atlas/chart_check.h"
#include "atlas/flatten.h"
#include "atlas/join_charts.h"
#include "atlas/patches.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

constexpr int first_rounds = 12, last_rounds = 30;

Seams seams_between(const SurfaceMesh& mesh, std::span<const std::uint32_t> patches) {
    Seams seams(mesh.triangles.size());
    for (std::size_t t = 0; t < seams.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const TriangleEdge other = mesh.across[t][k];
            seams[t][k] = !other.exists() || patches[other.triangle] != patches[t];
        }
    }
    return seams;
}

/// Cuts between triangles of two parts, which are numbered 0 and 1 here.
void cut_between(const SurfaceMesh& mesh, std::span<const std::vector<std::uint32_t>, 2> parts,
                 std::span<std::uint32_t> numbers, Seams& seams) {
    for (std::uint32_t side = 0; side < 2; ++side) {
        for (const std::uint32_t t : parts[side]) numbers[t] = side;
    }
    for (const auto& part : parts) {
        for (const std::uint32_t t : part) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (!seams[t][k]) seams[t][k] = numbers[mesh.across[t][k].triangle] != numbers[t];
            }
        }
    }
}

Vector3d mean_normal(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles) {
    Vector3d sum;
    for (const std::uint32_t t : triangles) sum = sum + mesh.double_area_normal(t);
    return unit(sum);
}

/// Lays a patch flat, in as many parts as it takes.
std::vector<Chart> flat_parts(const SurfaceMesh& mesh, std::vector<std::uint32_t> patch,
                              std::span<std::uint32_t> numbers, Seams& seams) {
    std::vector<Chart> done;
    std::vector<std::vector<std::uint32_t>> waiting;
    waiting.push_back(std::move(patch));
    while (!waiting.empty()) {
        Chart chart = chart_of(mesh, seams, std::move(waiting.back()), numbers);
        waiting.pop_back();
        if (chart.triangles.size() == 1) {
            const FlatTriangle shape = shape_of(mesh, chart.triangles[0]);
            chart.places.assign(shape.begin(), shape.end());
            done.push_back(std::move(chart));
            continue;
        }
        turn_towards(mesh, mean_normal(mesh, chart.triangles), chart);
        flatten(mesh, chart, first_rounds);
        if (is_good(mesh, seams, chart)) {
            done.push_back(std::move(chart));
            continue;
        }
        auto parts = halves(mesh, seams, chart, numbers);
        cut_between(mesh, parts, numbers, seams);
        for (auto& part : parts) waiting.push_back(std::move(part));
    }
    return done;
}

}  // namespace

std::vector<Chart> make_charts(const SurfaceMesh& mesh, Team& team,
                               const std::atomic<bool>& cancel) {
    std::vector<std::vector<std::uint32_t>> patches;
    Seams seams;
    {
        const std::vector<std::uint32_t> patch_of = bend_patches(mesh, cancel);
        if (cancel) return {};
        seams = seams_between(mesh, patch_of);
        for (std::uint32_t t = 0; t < patch_of.size(); ++t) {
            if (patch_of[t] >= patches.size()) patches.resize(patch_of[t] + 1);
            patches[patch_of[t]].push_back(t);
        }
    }
    std::vector<std::uint32_t> numbers(mesh.triangles.size());
    std::vector<std::vector<Chart>> parts(patches.size());
    in_turn(team, patches.size(), cancel, [&](std::size_t k) {
        parts[k] = flat_parts(mesh, std::move(patches[k]), numbers, seams);
    });
    std::vector<Chart> charts;
    for (auto& part : parts) {
        std::move(part.begin(), part.end(), std::back_inserter(charts));
    }
    if (cancel) return charts;
    charts = join_charts(mesh, std::move(charts), seams, numbers, team, cancel);
    in_turn(team, charts.size(), cancel, [&](std::size_t k) {
        Chart better = charts[k];
        flatten(mesh, better, last_rounds);
        if (is_good(mesh, seams, better)) charts[k] = std::move(better);
    });
    return charts;
}

}  // namespace cascade
