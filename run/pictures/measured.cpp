// If the picture shows colours, measures the number that the stage shows by default.
#include "run/pictures/measured.h"

#include "core/spread.h"
#include "measure/spectrum.h"
#include "run/pictures/drawn_cells.h"
#include "run/simulation/grown_domain.h"
#include "tissue/tissue.h"

#include <array>
#include <limits>
#include <vector>

namespace cascade {

namespace {

measure::Features without_places(const std::vector<double>& values) {
    std::array<double, measure::feature_count> unknown{};
    unknown.fill(std::numeric_limits<double>::quiet_NaN());
    measure::Features features = measure::from_array(unknown);
    const Spread spread = spread_of([&](const auto& take) {
        for (const double value : values) take(value);
    });
    if (spread.count == 0) return features;
    features.mean = spread.mean;
    features.deviation = spread.deviation();
    features.smallest = spread.smallest;
    features.largest = spread.largest;
    return features;
}

}  // namespace

Field shown_number(Painter& painter, const Simulation& simulation) {
    Canvas shown = painter.values(simulation);
    if (!shown.is_colour()) return std::move(shown.fields[0]);
    const std::uint32_t stage = shown_stage(simulation);
    return std::move(simulation.evaluate(simulation.domain().stage(stage).show, stage)[0]);
}

std::string name_of_number(const Script& script, std::uint32_t stage,
                           const PictureRequest& request) {
    if (!request.show.empty()) return request.show;
    const Formula& show = script.program->stages[stage].show;
    if (show.nodes.empty()) return {};
    const auto* const item = show.nodes.back().as<ItemId>();
    return item == nullptr ? std::string()
                           : std::string(script.program->system_of(stage).item_name(*item));
}

measure::Features measure_shown(Painter& painter, const Simulation& simulation) {
    const Field shown = shown_number(painter, simulation);
    const Tissue* const tissue = simulation.state(shown_stage(simulation)).tissue();
    if (tissue) return without_places(number_order(shown, *tissue));
    if (const auto& model = simulation.domain().model)
        return without_places(cell_values(shown, *model->cells));
    measure::Samples samples = measure::to_samples(shown, simulation.domain().grid);
    samples.spacing = cell_lengths(simulation, shown_stage(simulation));
    return measure::measure(samples);
}

double shown_length(Painter& painter, const Simulation& simulation) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (simulation.state(shown_stage(simulation)).tissue() || simulation.domain().model)
        return none;
    const measure::Samples samples =
        measure::to_samples(shown_number(painter, simulation), simulation.domain().grid);
    const Spread spread = spread_of([&](const auto& take) {
        for (const double value : samples.values) take(value);
    });
    if (spread.is_uniform()) return none;
    return measure::first_moment_length(measure::radial_spectrum(samples));
}

}  // namespace cascade
