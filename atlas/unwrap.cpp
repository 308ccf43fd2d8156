// Charts are made of a copy whose area is 1.
#include "atlas/unwrap.h"

#include "atlas/make_charts.h"
#include "atlas/pack_charts.h"
#include "core/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// The triangles alone, moved to the origin and scaled.
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
        return failure(fmt::format("the model falls into {}, too many for a texture of {} × {}",
                                   counted(std::ssize(charts), "separate part"), texels, texels),
                       "a larger texture has room for more");
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
