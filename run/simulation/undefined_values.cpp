// For each part of a formula in which a NaN may be lost, evaluates a second formula that is true
// where a NaN is lost.
#include "run/simulation/undefined_values.h"

#include "run/domain/field_values.h"
#include "solvers/field_norms.h"
#include "solvers/finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// If the deviation of a picture is smaller than this, all its pixels have the same grey. The
/// deviation is larger even if only one of 2²⁶ pixels differs by one of 256 grey levels.
constexpr double one_level = 1e-7;

/// Returns the first cell of the domain for which `is_found(value)` is true.
template <typename Test>
std::optional<CellPlace> first_cell(const Field& field, const Mask* counted, Test is_found) {
    return field.visit([&](const auto& plane) -> std::optional<CellPlace> {
        const PlaneLayout& layout = plane.layout();
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            for (std::int64_t i = 0; i < layout.width; ++i) {
                if (counted != nullptr && counted->row(row)[i] == 0) continue;
                if (is_found(double{plane.row(row)[i]}))
                    return CellPlace{i, row % layout.height, row / layout.height};
            }
        }
        return std::nullopt;
    });
}

/// Whether a formula contains only numbers and calls of functions. The checker has already reported
/// such formulas.
bool is_constant(const Formula& formula) {
    return std::all_of(formula.nodes.begin(), formula.nodes.end(),
                       [](const Node& node) { return node.is<double>() || node.is<Call>(); });
}

std::string not_finite_words(double value) {
    return std::isnan(value) ? "not a number" : "infinite";
}

constexpr const char* for_comparisons = "comparisons treat it as false";

/// Returns the parts to watch in formulas that are evaluated in each step.
std::vector<UndefinedWatch> watched_in_steps(const System& system) {
    LostNumbers lost(system);
    std::vector<UndefinedWatch> watched;
    const auto watch = [&](std::vector<LostNumber> found, const std::string& where,
                           const char* effect) {
        for (LostNumber& each : found) watched.push_back({where, effect, std::move(each)});
    };
    for (const ItemId item : system.rate_order) {
        watch(lost.in_rate(item), fmt::format("in the rate of {}", system.item_name(item)),
              for_comparisons);
    }
    for (const Invariant& invariant : system.invariants) {
        watch(lost.as_whole(invariant.bound),
              fmt::format("in the bound of {}", system.item_name(invariant.species)),
              "there is no bound there");
    }
    return watched;
}

/// Returns the parts to watch in formulas that are evaluated once, at the start of the stage.
std::vector<UndefinedWatch> watched_at_start(const Stage& stage, const System& system) {
    LostNumbers lost(system);
    std::vector<UndefinedWatch> watched;
    for (const ItemId item : system.items()) {
        for (LostNumber& each : lost.in_comparisons(stage.items[item])) {
            watched.push_back({fmt::format("in the value of {}", system.item_name(item)),
                               for_comparisons, std::move(each)});
        }
    }
    return watched;
}

std::vector<UndefinedWatch> watched_in_until(const Stage& stage, const System& system) {
    std::vector<UndefinedWatch> watched;
    if (!stage.time.until) return watched;
    LostNumbers lost(system);
    for (LostNumber& each : lost.in_comparisons(*stage.time.until)) {
        watched.push_back({"in 'until'", "it does not end the stage", std::move(each)});
    }
    for (LostNumber& each : lost.as_whole(*stage.time.until)) {
        watched.push_back({"'until' itself", "that counts as true", std::move(each)});
    }
    return watched;
}

/// Warns of the first part that is NaN at present. Returns false if no part is NaN.
bool warn_of_lost(const StageView& view, std::span<const UndefinedWatch> watched,
                  const RunControl& control) {
    if (watched.empty()) return false;
    std::vector<const Formula*> formulas;
    for (const UndefinedWatch& each : watched) formulas.push_back(&each.number.is_lost);
    const std::vector<Field> found = view.evaluate(formulas);
    const Environment& here = view.environment();
    for (std::size_t n = 0; n < watched.size(); ++n) {
        const auto place =
            first_cell(found[n], here.counted(), [](double value) { return value > 0; });
        if (!place) continue;
        // An aggregate has the same value in all cells, so the message names no cell.
        const std::string where = is_same_everywhere(found[n])
                                      ? ""
                                      : " at " + here.place_in_words(place->column, place->row);
        control.warn(
            fmt::format("stage '{}': {} {} is not a number{}, {}: {}", view.stage().name,
                        here.script.sources.text(watched[n].number.span), watched[n].where, where,
                        view.state().steps == 0 ? "at the start"
                                                : fmt::format("after step {}", view.state().steps),
                        watched[n].effect));
        return true;
    }
    return false;
}

bool warn_of_undefined_parameters(const StageView& view, const RunControl& control) {
    const System& system = view.system();
    const StageState& state = view.state();
    const Environment& here = view.environment();
    const auto is_undefined = [](double value) { return !std::isfinite(value); };
    for (const ItemId item : system.items()) {
        if (system.is_species(item) || item == system.speed_item()) continue;
        std::string place;
        double value = state.numbers[item];
        if (const Field& field = state.field(item); !field.empty()) {
            if (are_finite(field, {{0, field.layout().row_count()}})) continue;
            const auto cell = first_cell(field, here.counted(), is_undefined);
            if (!cell) continue;
            value = field.number_at(cell->column, cell->row, cell->slice);
            place = " at " + here.place_in_words(cell->column, cell->row);
        } else if (!view.stage().uniform[item] || !is_undefined(value) ||
                   is_constant(view.stage().items[item])) {
            continue;
        }
        control.warn(fmt::format("stage '{}': {} is {}{}{}", view.stage().name,
                                 system.item_name(item), not_finite_words(value), place,
                                 item == system.frozen_item() ? ", which counts as true" : ""));
        return true;
    }
    return false;
}

bool is_silent(const StageView& view, const RunControl& control) {
    return !control.warn || !view.environment().runs_as_written();
}

}  // namespace

void UndefinedValues::look_at_start(const StageView& view, const RunControl& control) {
    if (is_silent(view, control)) return;
    is_told_ = warn_of_undefined_parameters(view, control) ||
               warn_of_lost(view, watched_at_start(view.stage(), view.system()), control) ||
               warn_of_lost(view, watched_in_steps(view.system()), control);
}

void UndefinedValues::look_at_end(const StageView& view, const RunControl& control) {
    if (is_silent(view, control) || is_told_) return;
    is_told_ = warn_of_lost(view, watched_in_steps(view.system()), control);
}

void UndefinedValues::look_at_until(const StageView& view, const RunControl& control) {
    if (!control.warn || until_is_told_) return;
    if (!in_until_) in_until_ = watched_in_until(view.stage(), view.system());
    until_is_told_ = warn_of_lost(view, *in_until_, control);
}

void warn_of_uniform_pictures(const Environment& environment, const RunControl& control) {
    if (!control.warn) return;
    const Literals& literals = *environment.program->literals;
    environment.files.each_of(Function::image, [&](const NamedPlane& name, const Field& plane) {
        const FileReading& reading = literals.reading(name.reading);
        const FieldMoments levels = moments(plane);
        if (levels.deviation > one_level || reading.is_direction) return;
        const bool is_lightness = reading.channel == PictureChannel::lightness;
        control.warn(fmt::format(
            "image(\"{}\"{}) is {:.4g} in all cells{}", literals.text(name.text),
            is_lightness ? "" : fmt::format(", \"{}\"", name_of(reading.channel)), levels.mean,
            is_lightness && levels.mean > 1 - one_level
                ? ": is the picture transparent? Transparent pixels count as white"
                : ""));
    });
}

void warn_of_undefined_mask(const Environment& environment,
                            const std::function<Field(const StepPlan&)>& evaluate,
                            const RunControl& control) {
    const Program& program = *environment.program;
    LostNumbers lost(program.system_of(0));
    const Formula& mask_formula = program.domain.mask->formula;
    std::vector<LostNumber> found = lost.in_comparisons(mask_formula);
    for (LostNumber& each : lost.as_whole(mask_formula)) found.push_back(std::move(each));
    for (const LostNumber& each : found) {
        Program asked = program;
        asked.domain.mask->formula = each.is_lost;
        const auto place =
            first_cell(evaluate(plan_mask(asked)), nullptr, [](double value) { return value > 0; });
        if (!place) continue;
        return control.warn(
            fmt::format("the mask of the domain: {} is not a number at {}, which counts as outside",
                        environment.script.sources.text(each.span),
                        environment.place_in_words(place->column, place->row)));
    }
}

}  // namespace cascade
