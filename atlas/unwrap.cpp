// Works on a copy of the surface whose area is 1.
#include "atlas/unwrap.h"

#include "atlas/chart.h"
#include "atlas/chart_check.h"
#include "atlas/flatten.h"
#include "atlas/join_charts.h"
#include "atlas/pack_charts.h"
#include "atlas/patches.h"
#include "core/counted.h"
#include "core/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

// Cuts a surface into flat charts.

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

/// Makes seams between the triangles of two parts. `numbers` is overwritten with 0 or 1 for these
/// triangles.
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

/// Flattens a patch, in as many parts as necessary.
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

/// Divides a surface of area 1 into flat charts without overlaps (is_injective). In a chart of more
/// than 1/512 of the area the mean distortion is at most 1.1, and it exceeds 1.5 in at most 1 % of
/// the chart's area. Patches that bend little (bend_patches) are halved until they fulfil these
/// conditions. Charts are then joined again along common edges as long as the joined charts still
/// fulfil the conditions. Pairs whose border is the largest fraction of the shorter outline come
/// first. The result is the same with any number of threads. It is incomplete if `cancel` became
/// true.
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

/// The surface without texture coordinates and attributes, moved to the origin and scaled to a
/// total area of 1.
SurfaceMesh of_unit_area(const SurfaceMesh& mesh) {
    SurfaceMesh copy;
    copy.triangles = mesh.triangles;
    copy.across = mesh.across;
    const SurfaceMesh::Box box = mesh.box();
    const Vector3d size = box.high - box.low;
    const double longest = std::max({size.x, size.y, size.z});
    const auto scale = [&](Vector3d origin, double factor, std::span<const Vector3d> points) {
        std::vector<Vector3d> scaled;
        scaled.reserve(points.size());
        for (const Vector3d& p : points) scaled.push_back((p - origin) * factor);
        return scaled;
    };
    copy.points = scale(box.low, 1 / longest, mesh.points);
    copy.points = scale({}, 1 / std::sqrt(copy.total_area()), copy.points);
    return copy;
}

}  // namespace

Result<MeshTexture> unwrap(const SurfaceMesh& mesh, std::int64_t texels, Team& team,
                           const std::atomic<bool>& cancel) {
    std::vector<Chart> charts = make_charts(of_unit_area(mesh), team, cancel);
    const auto cells = [&](std::int64_t gap) {
        return static_cast<int>(std::max<std::int64_t>(8, texels / gap));
    };
    double scale = pack_charts(charts, std::min(512, cells(2)), cancel);
    if (scale == 0 && !cancel) scale = pack_charts(charts, std::min(4096, cells(1)), cancel);
    MeshTexture texture(mesh.triangles.size());
    if (cancel) return texture;
    if (scale == 0) {
        return failure(fmt::format("the model consists of {}, too many for a texture of {} × {}",
                                   counted(std::ssize(charts), "separate part"), texels, texels),
                       "use a larger texture");
    }
    for (const Chart& chart : charts) {
        for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
            const FlatTriangle flat = chart.flat(n);
            for (std::size_t k = 0; k < 3; ++k) {
                texture[chart.triangles[n]][k] = {static_cast<float>(flat[k].x),
                                                  static_cast<float>(flat[k].y)};
            }
        }
    }
    return texture;
}

}  // namespace cascade
