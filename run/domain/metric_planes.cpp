// Evaluates the script's formulas in binary64, and copies the metric to planes.
#include "run/domain/metric_planes.h"

#include "lang/program/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

SurfaceFunction function_of(const SurfaceSettings& surface) {
    return [&surface](double sx, double sy) {
        BuiltinValues place{};
        place[static_cast<std::size_t>(Builtin::sx)] = sx;
        place[static_cast<std::size_t>(Builtin::sy)] = sy;
        Position position{};
        for (std::size_t k = 0; k < 3; ++k) position[k] = evaluate(surface.position[k], place);
        return position;
    };
}

std::optional<double> unit_of(const SurfaceSettings& surface, const Grid& grid) {
    if (!surface.extent) return surface.unit;
    const SurfaceFunction function = function_of(surface);
    constexpr double far = std::numeric_limits<double>::infinity();
    Position low{far, far, far}, high{-far, -far, -far};
    for (std::int64_t j = 0; j <= grid.height; ++j) {
        for (std::int64_t i = 0; i <= grid.width; ++i) {
            const Position corner =
                function(static_cast<double>(i) / static_cast<double>(grid.width),
                         static_cast<double>(j) / static_cast<double>(grid.height));
            for (std::size_t k = 0; k < corner.size(); ++k) {
                if (!std::isfinite(corner[k])) continue;
                low[k] = std::min(low[k], corner[k]);
                high[k] = std::max(high[k], corner[k]);
            }
        }
    }
    double longest = 0;
    for (std::size_t k = 0; k < low.size(); ++k) longest = std::max(longest, high[k] - low[k]);
    return longest / *surface.extent;
}

Result<std::vector<Field>> metric_planes(const Program& program) {
    const auto& surface = program.domain.surface;
    std::vector<Field> planes;
    if (!surface || !surface->has_metric) return planes;
    auto metric = measure_surface(function_of(*surface), program.domain.grid,
                                  unit_of(*surface, program.domain.grid), program.domain.precision,
                                  program.domain.detail);
    if (!metric) return tl::unexpected(metric.error());
    planes.resize(metric_plane_count);
    const auto put = [&](MetricPlane plane, Field& field) {
        planes[static_cast<std::size_t>(plane)] = std::move(field);
    };
    put(MetricPlane::inverse_11, metric->inverse_11);
    put(MetricPlane::inverse_12, metric->inverse_12);
    put(MetricPlane::inverse_22, metric->inverse_22);
    put(MetricPlane::area, metric->area);
    put(MetricPlane::flow_11, metric->flow_11);
    put(MetricPlane::flow_12, metric->flow_12);
    put(MetricPlane::flow_22, metric->flow_22);
    return planes;
}

}  // namespace cascade
