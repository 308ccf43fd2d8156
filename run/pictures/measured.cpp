// Copies the rows without padding; if the picture shows colours, the stage's default number is
// measured.
#include "run/pictures/measured.h"

namespace cascade {

measure::Samples to_samples(const Field& field, const Grid& grid) {
    measure::Samples samples;
    samples.cells = {static_cast<std::size_t>(grid.width), static_cast<std::size_t>(grid.height),
                     static_cast<std::size_t>(grid.depth)};
    const Boundaries& boundary = grid.boundary;
    samples.periodic = {boundary.x == Boundary::periodic, boundary.y == Boundary::periodic,
                        boundary.z == Boundary::periodic};
    samples.spacing = grid.spacing;
    samples.values.reserve(static_cast<std::size_t>(grid.cell_count()));
    field.visit([&](const auto& plane) {
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            samples.values.insert(samples.values.end(), plane.row(row),
                                  plane.row(row) + grid.width);
        }
    });
    return samples;
}

Field shown_number(Painter& painter, const Simulation& simulation) {
    Canvas shown = painter.values(simulation);
    if (!shown.is_colour()) return std::move(shown.fields[0]);
    const std::uint32_t stage = simulation.shown_stage().value_or(0);
    return std::move(simulation.evaluate(simulation.program().stages[stage].show, stage)[0]);
}

measure::Features measure_shown(Painter& painter, const Simulation& simulation) {
    return measure::measure(to_samples(shown_number(painter, simulation), simulation.grid()));
}

}  // namespace cascade
