// Evaluates the script's formulas in binary64, and copies the metric to planes.
#include "run/domain/metric_planes.h"

#include "lang/program/evaluate.h"

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

Result<std::vector<Field>> metric_planes(const Program& program) {
    const auto& surface = program.domain.surface;
    std::vector<Field> planes;
    if (!surface || !surface->has_metric) return planes;
    auto metric = measure_surface(function_of(*surface), program.domain.grid, surface->unit,
                                  program.domain.precision, program.domain.detail);
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
