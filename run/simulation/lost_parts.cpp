// Some parts of rates, and of rules at sides, are lost by rounding. They are compared with the
// whole rate or rule, and with the values of the species.
#include "run/simulation/lost_parts.h"

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

/// A warning is given if the lost part is at least the fraction `least_of_whole` of its formula,
/// and changes values by at least the fraction `least_of_values` during the stage.
constexpr double least_of_whole = 1e-3, least_of_values = 0.01;
/// Values below this are not examined, because they will soon underflow to 0 in any case.
constexpr double least_value = 1e-34;
/// The time that is assumed for a stage without a known end.
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
    if (const Field& field = state.field(item); !field.empty()) return magnitude_in(field, counted);
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

/// Whether a rate is not finite in a cell in which the part is lost. A part that may be too large
/// is lost where it is infinite. Any other part is lost where it is 0.
bool spoils_its_rate(const StageView& view, const LostPart& found) {
    const std::vector<Field> rates = view.rates();
    const Field part = std::move(view.evaluate(found.part)[0]);
    const auto is_lost = [&](double value) {
        return found.cause == LostPart::Cause::too_large ? std::isinf(value) : value == 0;
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

/// Returns the change of values near a side that is missing because part of the side's rule is
/// lost.
double change_at_side(const StageView& view, const LostPart& found) {
    const Grid& grid = view.environment().grid;
    switch (found.kind) {
        case SideKind::slope: return found.lost * grid.spacing * static_cast<double>(grid.width);
        case SideKind::flux: return found.lost * time_of(view) / grid.spacing;
        default: return found.lost;
    }
}

bool changes_the_result(const StageView& view, const LostPart& found) {
    if (found.cause == LostPart::Cause::too_large) return spoils_its_rate(view, found);
    if (!(found.lost >= least_of_whole * found.whole)) return false;
    const double values = magnitude_of(view, found.species).most;
    if (found.side) {
        return change_at_side(view, found) >= least_of_values * std::max(values, least_value);
    }
    const auto species = view.state().species_of_item[found.species];
    const StageCourse& course = view.state().course;
    const double once = course.empty() ? 0 : course.last().largest[species->index()];
    if (!(values > std::max(least_value, remaining_part * once))) return false;
    return found.lost * time_of(view) >= least_of_values * values ||
           (found.cause == LostPart::Cause::too_small && spoils_its_rate(view, found));
}

/// Describes a lost part: "a * b in the rate of u is at most 3e-40 at the start, too small for
/// single precision, …".
std::string words_for(const StageView& view, const LostPart& found) {
    const Sources& sources = view.environment().script.sources;
    const std::string name(view.system().item_name(found.species));
    const std::string where =
        found.side ? fmt::format("at the side '{}' of {}",
                                 side_names[static_cast<std::size_t>(*found.side)], name)
                   : "in the rate of " + name;
    const bool is_too_large = found.cause == LostPart::Cause::too_large;
    const std::int64_t steps = view.state().steps;
    const std::string trouble =
        found.cause == LostPart::Cause::swallowed
            ? fmt::format("too small to be added to {} in single precision",
                          sources.text(found.other))
            : fmt::format("too {} for single precision, which takes it for {}",
                          is_too_large ? "large" : "small", is_too_large ? "infinite" : "0");
    return fmt::format(
        "stage '{}': {} {} is {} {:.2g} {}, {}; 'precision: double' in the domain avoids this loss",
        view.stage().name, sources.text(found.span), where, is_too_large ? "up to" : "at most",
        found.value, steps == 0 ? "at the start" : fmt::format("after step {}", steps), trouble);
}

}  // namespace

void LostParts::look(const StageView& view, const RunControl& control) {
    const Environment& here = view.environment();
    if (are_told_ || !control.warn || !here.runs_as_written() || view.system().cells) return;
    if (here.precision() != Precision::single) return;
    std::unordered_map<ItemId, Magnitude> known;
    const auto of = [&](ItemId item) {
        const auto found = known.find(item);
        if (found != known.end()) return found->second;
        return known.emplace(item, magnitude_of(view, item)).first->second;
    };
    for (const LostPart& found : find_lost_parts(view.program(), view.number(), of)) {
        if (!changes_the_result(view, found)) continue;
        control.warn(words_for(view, found));
        are_told_ = true;
        return;
    }
}

}  // namespace cascade
