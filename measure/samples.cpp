// Copies the rows of a field without their padding.
#include "measure/samples.h"

namespace cascade::measure {

Samples to_samples(const Field& field, const Grid& grid) {
    Samples samples;
    samples.cells = {static_cast<std::size_t>(grid.width), static_cast<std::size_t>(grid.height),
                     static_cast<std::size_t>(grid.depth)};
    const Boundaries& boundary = grid.boundary;
    samples.periodic = {boundary.x == Boundary::periodic, boundary.y == Boundary::periodic,
                        boundary.z == Boundary::periodic};
    samples.spacing.fill(grid.spacing);
    samples.values.reserve(static_cast<std::size_t>(grid.cell_count()));
    field.visit([&](const auto& plane) {
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            samples.values.insert(samples.values.end(), plane.row(row),
                                  plane.row(row) + grid.width);
        }
    });
    return samples;
}

}  // namespace cascade::measure
