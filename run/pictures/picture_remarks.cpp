#include "run/pictures/picture_remarks.h"

#include "measure/resolution.h"
#include "run/pictures/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// A spectrum of more cells would cost as much as many steps.
constexpr std::int64_t most_cells_of_spectrum = std::int64_t{1} << 20;
/// As many levels as a picture of 8 bits has.
constexpr double levels = 256;

std::string ends_of(const Spread& values) {
    return fmt::format("{:.4g} to {:.4g}", values.smallest, values.largest);
}

std::string describe_range(const Spread& values, ValueRange range) {
    const double low = std::min(range.low, range.high), high = std::max(range.low, range.high);
    const auto about = [&](const char* words) {
        return fmt::format("the picture is of one colour: all it shows ({}) {} the range {:.4g},{:.4g}",
                           ends_of(values), words, range.low, range.high);
    };
    if (values.largest < low) return about("lies below");
    if (values.smallest > high) return about("lies above");
    if (values.largest - values.smallest < (high - low) / levels) return about("is one level of");
    return {};
}

std::string describe_even(const Canvas& canvas) {
    const bool is_even = std::all_of(canvas.fields.begin(), canvas.fields.end(), [](const Field& field) {
        return spread_of(field).is_even();
    });
    if (!is_even) return {};
    if (canvas.is_colour()) return "the picture is of one colour";
    if (spread_of(canvas.fields[0]).count == 0) {
        return "the picture is of one colour: what it shows is infinite or not a number in all cells";
    }
    return fmt::format("the picture is of one colour: what it shows is {:.4g} in all cells",
                       spread_of(canvas.fields[0]).mean);
}

std::string describe_waves(Painter& painter, const Simulation& simulation) {
    if (simulation.model() || simulation.grid().cell_count() > most_cells_of_spectrum) return {};
    const double cells = measure::unresolved_wavelength(
        to_samples(shown_number(painter, simulation), simulation.grid()));
    if (std::isnan(cells)) return {};
    return fmt::format("the waves of the pattern are {:.2g} cells long: with fewer than {:.0f} the grid "
                       "shapes them as much as the equations do",
                       cells, measure::fewest_cells_a_wave);
}

}  // namespace

std::string remark_on_picture(Painter& painter, const Simulation& simulation) {
    const auto stage = simulation.shown_stage();
    if (!stage) return {};
    const StageCourse& course = simulation.state(*stage).course;
    if (course.empty() || course.ended_even()) return {};
    const Canvas canvas = painter.canvas(simulation);
    if (painter.request().range && !canvas.is_colour()) {
        std::string remark = describe_range(spread_of(canvas.fields[0]), *painter.request().range);
        if (!remark.empty()) return remark;
    }
    if (!simulation.remark_on(*stage).empty()) return {};
    std::string remark = describe_even(canvas);
    return remark.empty() ? describe_waves(painter, simulation) : remark;
}

}  // namespace cascade
