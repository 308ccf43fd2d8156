// Makes an implicit surface from values that are interpolated between the centres of the grid's
// cells.
#include "run/tissue/grown_body.h"

#include "mesh/implicit_surface.h"
#include "tissue/sense_kernel.h"

#include <algorithm>

namespace cascade {

Result<SurfaceMesh> grown_body(const Field& values, Boundaries boundary,
                               const std::atomic<bool>& cancel, double edge) {
    const PlaneLayout& layout = values.layout();
    const double cell =
        1.0 / static_cast<double>(std::max({layout.width, layout.height, layout.depth}));
    const Vector3d extent{static_cast<double>(layout.width) * cell,
                          static_cast<double>(layout.height) * cell,
                          static_cast<double>(layout.depth) * cell};
    const PlaceValue value = of_grid(values, boundary);
    const auto inside = [&](std::span<const Vector3d> points, std::span<double> results) {
        NearPlace place;
        for (std::size_t k = 0; k < points.size(); ++k) {
            place.position = points[k];
            const Vector3d far = extent - points[k];
            const double depth =
                std::min({points[k].x, points[k].y, points[k].z, far.x, far.y, far.z});
            results[k] = depth <= 0 ? depth : std::min(value(place), depth / cell);
        }
    };
    ImplicitRequest request;
    request.edge = edge * cell;
    const Vector3d margin{2 * request.edge, 2 * request.edge, 2 * request.edge};
    request.low = Vector3d{} - margin;
    request.high = extent + margin;
    return implicit_surface(inside, request, cancel);
}

}  // namespace cascade
