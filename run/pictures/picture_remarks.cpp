// Detects pictures of a single colour, and waves that are too short for the grid.
#include "run/pictures/picture_remarks.h"

#include "measure/resolution.h"
#include "mesh/surface_mesh.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/measured.h"
#include "run/simulation/end_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// The largest number of cells of a grid for which a spectrum is computed. In a larger grid, the
/// spectrum would take as much time as many steps.
constexpr std::int64_t most_cells_of_spectrum = std::int64_t{1} << 20;
/// Waves count as too short for the grid if short waves contribute more than this fraction of a
/// pattern's variance. For white noise on a plane the fraction is 0.8.
constexpr double mostly_unresolved = 0.7;
/// The number of greys that a picture with 8 bits can show.
constexpr double levels = 256;

constexpr const char* is_one_colour = "the picture is of one colour";

std::string ends_of(const Spread& values) {
    return fmt::format("{:.4g} to {:.4g}", values.smallest, values.largest);
}

std::string describe_range(const Spread& values, ValueRange range) {
    const double low = std::min(range.low, range.high), high = std::max(range.low, range.high);
    const auto about = [&](const char* words) {
        return fmt::format("{}: all shown values ({}) {} the range {:.4g},{:.4g}", is_one_colour,
                           ends_of(values), words, range.low, range.high);
    };
    if (values.largest < low) return about("lie below");
    if (values.smallest > high) return about("lie above");
    if (values.largest - values.smallest < (high - low) / levels)
        return about("lie within one level of");
    return {};
}

/// If the picture has a single colour because red, green and blue each differ by less than one
/// level after they are clamped to 0 … 1, says so. Otherwise returns an empty string.
std::string describe_clamped(const Canvas& canvas) {
    const bool is_uniform =
        std::all_of(canvas.fields.begin(), canvas.fields.end(), [](const Field& field) {
            const Spread values = spread_of(field);
            return values.count > 0 &&
                   std::clamp(values.largest, 0.0, 1.0) - std::clamp(values.smallest, 0.0, 1.0) <
                       1 / levels;
        });
    if (!is_uniform) return {};
    return fmt::format("{}: between 0 and 1, red, green and blue differ by less than one level",
                       is_one_colour);
}

/// Describes the first of roughness, metalness and opacity that has numbers outside of 0 … 1.
/// Returns an empty string if none has.
std::string describe_clamped(const MaterialFields& material) {
    constexpr std::pair<const char*, MaterialPart> settings[] = {
        {"roughness", MaterialPart::roughness},
        {"metalness", MaterialPart::metalness},
        {"opacity", MaterialPart::opacity},
    };
    for (const auto& [name, part] : settings) {
        const Field& field = material.parts[part];
        const Spread values = field.empty() ? Spread() : spread_of(field);
        if (values.count == 0 || (values.smallest >= 0 && values.largest <= 1)) continue;
        return fmt::format("the {} goes from {}: it is clamped to 0 … 1", name, ends_of(values));
    }
    return {};
}

std::string describe_uniform(const Canvas& canvas) {
    const bool is_uniform =
        std::all_of(canvas.fields.begin(), canvas.fields.end(),
                    [](const Field& field) { return spread_of(field).is_uniform(); });
    if (!is_uniform) return {};
    if (canvas.is_colour()) return is_one_colour;
    if (spread_of(canvas.fields[0]).count == 0) {
        return fmt::format("{}: the shown value is infinite or not a number in all cells",
                           is_one_colour);
    }
    const Spread values = spread_of(canvas.fields[0]);
    return fmt::format("{}: the shown value {} {:.4g}{}", is_one_colour,
                       values.is_one_number() ? "is" : "differs by less than a 100,000th from",
                       values.mean, values.is_one_number() ? " in all cells" : "");
}

std::string describe_waves(Painter& painter, const Simulation& simulation, std::uint32_t stage) {
    if (simulation.domain().model || simulation.domain().grid.cell_count() > most_cells_of_spectrum)
        return {};
    const measure::Samples samples =
        measure::to_samples(shown_number(painter, simulation), simulation.domain().grid);
    const double cells = measure::unresolved_wavelength(samples);
    const char* const why = "the grid shapes them as much as the equations do";
    if (!std::isnan(cells)) {
        return fmt::format("the waves of the pattern are {:.2g} cells long: below {:.0f} cells {}",
                           cells, measure::fewest_cells_a_wave, why);
    }
    if (!made_its_pattern(simulation, stage)) return {};
    const double part = measure::unresolved_part(samples);
    if (part < mostly_unresolved) return {};
    return fmt::format("{:.0f} % of the pattern consists of waves shorter than {:.0f} cells: {}",
                       100 * part, measure::fewest_cells_a_wave, why);
}

}  // namespace

std::string remark_on_picture(Painter& painter, const Simulation& simulation,
                              const Canvas& canvas) {
    const std::uint32_t stage = shown_stage(simulation);
    const StageState& state = simulation.state(stage);
    if (!state.started) return {};
    if (canvas.cells) return canvas.cells->fault;
    if (state.course.empty() || state.course.ended_uniform()) return {};
    if (canvas.body) {
        return canvas.body->points.empty()
                   ? "the body of the picture is empty: its formula is nowhere above 0"
                   : "";
    }
    if (painter.request().range && !canvas.is_colour()) {
        std::string remark = describe_range(spread_of(canvas.fields[0]), *painter.request().range);
        if (!remark.empty()) return remark;
    }
    if (!remark_on(simulation, stage).empty()) return {};
    std::string remark = describe_uniform(canvas);
    if (remark.empty() && canvas.is_colour()) remark = describe_clamped(canvas);
    return remark.empty() ? describe_waves(painter, simulation, stage) : remark;
}

std::string remark_on_look(const Painter& painter, const Simulation& simulation,
                           const Canvas& canvas) {
    const PictureRequest& request = painter.request();
    const bool has_palette = request.palette != PictureRequest().palette;
    if (!(has_palette || request.range) || !simulation.state(0).started) return {};
    // The canvas contains a number, so --palette and --range have an effect.
    if (canvas.number() != nullptr) return {};
    const char* const options = !request.range ? "--palette changes"
                                : has_palette  ? "--palette and --range change"
                                               : "--range changes";
    return fmt::format(
        "{} nothing: the script's picture is made of colours; --show draws a number instead",
        options);
}

std::string remark_on_material(const Script& script, const Canvas& canvas) {
    if (!canvas.body) return describe_clamped(canvas.material);
    const std::string settings = material_said(script);
    if (settings.empty()) return {};
    return fmt::format("the picture does not show {}: only pictures of surfaces and models do",
                       settings);
}

}  // namespace cascade
