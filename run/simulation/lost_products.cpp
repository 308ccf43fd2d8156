// Compares what rates lose with the values that they change.
#include "run/simulation/lost_products.h"

#include "core/counted_cells.h"
#include "lang/calculus/magnitudes.h"
#include "run/stage/stage_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>

namespace cascade {

namespace {

/// A loss is worth a warning if it is this part of the rate, and over the stage this part of the
/// values.
constexpr double least_of_rate = 1e-3, least_of_values = 0.01;
/// What is smaller is about to end as 0 anyway.
constexpr double least_value = 1e-34;
/// The time of a stage that has no known end.
constexpr double time_without_end = 10000;

Magnitude magnitude_in(const Field& field, const Mask* counted) {
    return field.visit([&](const auto& plane) {
        Magnitude size{INFINITY, 0, true};
        bool is_finite = true;
        for_each_counted(plane.layout(), counted, [&](std::int64_t row, std::int64_t i) {
            const double value = plane.row(row)[i];
            is_finite = is_finite && std::isfinite(value);
            size.least = std::min(size.least, std::abs(value));
            size.most = std::max(size.most, std::abs(value));
            size.is_positive = size.is_positive && value >= 0;
        });
        return is_finite && size.least <= size.most ? size : Magnitude{};
    });
}

Magnitude magnitude_of(const StageView& view, ItemId item) {
    const StageState& state = view.state();
    const Mask* counted = view.environment().counted();
    if (const auto species = state.species_of_item[item])
        return magnitude_in(state.species[species->index()], counted);
    if (!state.fields[item].empty()) return magnitude_in(state.fields[item], counted);
    const double number = state.numbers[item];
    return view.stage().uniform[item] && std::isfinite(number) ? Magnitude::of(number)
                                                               : Magnitude{};
}

double time_of(const StageView& view) {
    const double duration = duration_of(view.stage(), view.system(), view.state());
    if (std::isfinite(duration)) return duration;
    const double speed = view.step_in_use().speed;
    const bool ends = !view.stage().time.open_end && speed > 0;
    return ends ? static_cast<double>(view.stage().iterations) * speed : time_without_end;
}

/// Is the part lost in a cell whose rate is not finite: infinite if it may be too large, else 0?
bool spoils_its_rate(const StageView& view, const LostProduct& found) {
    const std::vector<Field> rates = view.rates();
    const Field part = std::move(view.evaluate(found.part)[0]);
    const auto is_lost = [&](double value) {
        return found.is_too_large ? std::isinf(value) : value == 0;
    };
    const auto species = view.state().species_of_item[found.species];
    const Mask* counted = view.environment().counted();
    const PlaneLayout& layout = part.layout();
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            if (counted != nullptr && counted->row(row)[i] == 0) continue;
            const std::int64_t j = row % layout.height, k = row / layout.height;
            if (is_lost(part.number_at(i, j, k)) &&
                !std::isfinite(rates[species->index()].number_at(i, j, k)))
                return true;
        }
    }
    return false;
}

bool changes_the_result(const StageView& view, const LostProduct& found) {
    if (found.is_too_large) return spoils_its_rate(view, found);
    const double values = magnitude_of(view, found.species).most;
    const auto species = view.state().species_of_item[found.species];
    const StageCourse& course = view.state().course;
    const double once = course.empty() ? 0 : course.last().largest[species->index()];
    if (!(values > std::max(least_value, remaining_part * once))) return false;
    if (!(found.lost >= least_of_rate * found.rate)) return false;
    return found.lost * time_of(view) >= least_of_values * values || spoils_its_rate(view, found);
}

}  // namespace

void LostProducts::look(const StageView& view, const RunControl& control) {
    const Environment& here = view.environment();
    if (are_told_ || !control.warn || !here.runs_as_written() || view.system().cells) return;
    if (here.precision() != Precision::single) return;
    std::unordered_map<ItemId, Magnitude> known;
    const auto of = [&](ItemId item) {
        const auto found = known.find(item);
        if (found != known.end()) return found->second;
        return known.emplace(item, magnitude_of(view, item)).first->second;
    };
    for (const LostProduct& found : find_lost_products(view.program(), view.number(), of)) {
        if (!changes_the_result(view, found)) continue;
        const std::int64_t steps = view.state().steps;
        control.warn(fmt::format(
            "stage '{}': {} in the rate of {} is {} {:.2g} {}, too {} for single precision, which "
            "takes it for {}; 'precision: double' in the domain keeps it",
            view.stage().name, here.script.sources.text(found.span),
            view.system().item_name(found.species), found.is_too_large ? "up to" : "at most",
            found.value, steps == 0 ? "at the start" : fmt::format("after step {}", steps),
            found.is_too_large ? "large" : "small", found.is_too_large ? "infinite" : "0"));
        are_told_ = true;
        return;
    }
}

}  // namespace cascade
