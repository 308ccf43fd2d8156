// Draws a body with the code that draws bodies below crawling cells, but with no cells on it.
#include "run/pictures/body_picture.h"

#include "core/counted_cells.h"
#include "core/run_control.h"
#include "lang/check/check.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/tissue_picture.h"
#include "run/tissue/grown_body.h"
#include "tissue/sense_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade {

std::shared_ptr<const SurfaceMesh> body_of(const Field& values, const DomainMask* mask,
                                           Boundaries boundary) {
    Field inside = mask ? with_outside(values, *mask, nothing_outside) : values.clone();
    if (inside.precision() != Precision::single) inside = inside.converted(Precision::single);
    float largest = 0, magnitude = 0;
    for_each_cell(
        [&](float value) {
            if (!std::isfinite(value)) return;
            largest = std::max(largest, value);
            magnitude = std::max(magnitude, std::abs(value));
        },
        inside);
    if (!(largest > 0)) return std::make_shared<const SurfaceMesh>();
    for_each_cell(
        [&](float& value) {
            value = std::isnan(value) ? -magnitude : std::clamp(value, -magnitude, magnitude);
        },
        inside);
    // The length, in cells, of the longest edges. With edges of this length, a surface in any grid
    // has few triangles.
    constexpr double coarsest = 64;
    for (double edge = 1; edge < coarsest; edge *= 2) {
        auto body = grown_body(inside, boundary, never_cancelled, edge);
        if (body) return std::make_shared<const SurfaceMesh>(*std::move(body));
    }
    return std::make_shared<const SurfaceMesh>();
}

Field at_points(const Field& values, const SurfaceMesh& body, Boundaries boundary) {
    const auto count = static_cast<std::int64_t>(body.points.size());
    Field row(PlaneLayout(Grid{std::max<std::int64_t>(count, 1), 1}));
    row.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    const PlaceValue value = of_grid(values, boundary);
    NearPlace near;
    for (std::int64_t k = 0; k < count; ++k) {
        near.position = body.points[static_cast<std::size_t>(k)];
        row.at(k, 0) = static_cast<float>(value(near));
    }
    return row;
}

Image draw_body(std::shared_ptr<const SurfaceMesh> body, std::span<const Colour> colours,
                const DrawOptions& options) {
    DrawnCells drawn;
    drawn.body = std::move(body);
    drawn.body_colours.assign(colours.begin(), colours.end());
    return draw_cells(drawn, {}, nullptr, nullptr, options);
}

}  // namespace cascade
