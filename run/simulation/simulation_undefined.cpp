// Values that are not numbers where no species would ever show it: in parameters, comparisons,
// bounds, conditions and the mask.
#include "lang/calculus/lost_numbers.h"
#include "run/simulation/simulation_implementation.h"
#include "solvers/field_norms.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Less than the deviation of a picture in which one of 2²⁶ pixels differs by a level of 8 bits.
constexpr double one_level = 1e-7;

/// Calls `is_found(value)` for the cells that count, in order; the first for which it is true.
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

/// Is it made of numbers alone? Then the check has spoken of it.
bool is_constant(const Formula& formula) {
    return std::all_of(formula.nodes.begin(), formula.nodes.end(), [](const Node& node) {
        return node.kind == NodeKind::number || node.kind == NodeKind::call;
    });
}

std::string not_finite_words(double value) {
    return std::isnan(value) ? "not a number" : "infinite";
}

constexpr const char* for_comparisons = "what compares it takes it for false";

}  // namespace

/// What steps read.
std::vector<UndefinedWatch> Simulation::Implementation::watched_in_steps(std::uint32_t k) const {
    const System& system = program->system_of(k);
    LostNumbers lost(system);
    std::vector<UndefinedWatch> watched;
    const auto watch = [&](std::vector<LostNumber> found, const std::string& where,
                           const char* effect) {
        for (LostNumber& each : found) watched.push_back({where, effect, std::move(each)});
    };
    for (const std::uint32_t item : system.rate_order) {
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

/// What is read once, when the stage starts.
std::vector<UndefinedWatch> Simulation::Implementation::watched_at_start(std::uint32_t k) const {
    const System& system = program->system_of(k);
    LostNumbers lost(system);
    std::vector<UndefinedWatch> watched;
    for (std::uint32_t item = 0; item < system.item_count(); ++item) {
        for (LostNumber& each : lost.in_comparisons(stage(k).items[item])) {
            watched.push_back({fmt::format("in the value of {}", system.item_name(item)),
                               for_comparisons, std::move(each)});
        }
    }
    return watched;
}

std::vector<UndefinedWatch> Simulation::Implementation::watched_in_until(std::uint32_t k) const {
    std::vector<UndefinedWatch> watched;
    if (!stage(k).time.until) return watched;
    LostNumbers lost(program->system_of(k));
    for (LostNumber& each : lost.in_comparisons(*stage(k).time.until)) {
        watched.push_back({"in 'until'", "the stage does not end by it", std::move(each)});
    }
    for (LostNumber& each : lost.as_whole(*stage(k).time.until)) {
        watched.push_back({"'until' itself", "that counts as true", std::move(each)});
    }
    return watched;
}

bool Simulation::Implementation::warn_of_lost(std::uint32_t k,
                                              std::span<const UndefinedWatch> watched,
                                              const RunControl& control) const {
    if (watched.empty()) return false;
    std::vector<const Formula*> formulas;
    for (const UndefinedWatch& each : watched) formulas.push_back(&each.number.is_lost);
    const std::vector<Field> found = evaluate(plan_view(*program, formulas, k), k);
    for (std::size_t n = 0; n < watched.size(); ++n) {
        const auto place = first_cell(found[n], counted(), [](double value) { return value > 0; });
        if (!place) continue;
        // An aggregate is the same in all cells.
        const std::string where =
            is_same_everywhere(found[n]) ? "" : " at " + place_in_words(place->column, place->row);
        control.warn(fmt::format(
            "stage '{}': {} {} is not a number{}, {}: {}", stage(k).name,
            script->sources.text(watched[n].number.span), watched[n].where, where,
            states[k].steps == 0 ? "at the start" : fmt::format("after step {}", states[k].steps),
            watched[n].effect));
        return true;
    }
    return false;
}

bool Simulation::Implementation::warn_of_undefined_parameters(std::uint32_t k,
                                                              const RunControl& control) const {
    const System& system = program->system_of(k);
    const StageState& state = states[k];
    const auto is_undefined = [](double value) { return !std::isfinite(value); };
    for (std::uint32_t item = 0; item < system.speed_item(); ++item) {
        if (system.is_species(item)) continue;
        std::string place;
        double value = state.numbers[item];
        if (!state.fields[item].empty()) {
            const auto cell = first_cell(state.fields[item], counted(), is_undefined);
            if (!cell) continue;
            value = state.fields[item].number_at(cell->column, cell->row, cell->slice);
            place = " at " + place_in_words(cell->column, cell->row);
        } else if (!stage(k).uniform[item] || !is_undefined(value) ||
                   is_constant(stage(k).items[item])) {
            continue;
        }
        control.warn(fmt::format("stage '{}': {} is {}{}{}", stage(k).name, system.item_name(item),
                                 not_finite_words(value), place,
                                 item == system.frozen_item() ? ", which counts as true" : ""));
        return true;
    }
    return false;
}

void Simulation::Implementation::warn_of_undefined_start(std::uint32_t k,
                                                         const RunControl& control) {
    // A coarser grid would repeat the warnings of the full one.
    if (!control.warn || own_program) return;
    undefined_is_told = warn_of_undefined_parameters(k, control) ||
                        warn_of_lost(k, watched_at_start(k), control) ||
                        warn_of_lost(k, watched_in_steps(k), control);
}

void Simulation::Implementation::warn_of_undefined_end(std::uint32_t k, const RunControl& control) {
    if (!control.warn || own_program || undefined_is_told) return;
    warn_of_lost(k, watched_in_steps(k), control);
}

void Simulation::Implementation::look_at_until(std::uint32_t k) const {
    if (listener == nullptr || !listener->warn || until_is_told) return;
    if (!until_watch) until_watch = watched_in_until(k);
    until_is_told = warn_of_lost(k, *until_watch, *listener);
}

void Simulation::Implementation::warn_of_even_pictures(const RunControl& control) const {
    if (!control.warn) return;
    files.each_of(SlotSource::Kind::image, [&](std::uint32_t text, const Field& plane) {
        const FieldMoments levels = moments(plane);
        if (levels.deviation > one_level) return;
        control.warn(fmt::format("image(\"{}\") is {:.4g} in all cells{}",
                                 program->literals->texts()[text], levels.mean,
                                 levels.mean > 1 - one_level
                                     ? ": is it all transparent? What is transparent lies on white"
                                     : ""));
    });
}

void Simulation::Implementation::warn_of_undefined_mask(const RunControl& control) {
    LostNumbers lost(program->system_of(0));
    const Formula& mask_formula = program->domain.mask->formula;
    std::vector<LostNumber> found = lost.in_comparisons(mask_formula);
    for (LostNumber& each : lost.as_whole(mask_formula)) found.push_back(std::move(each));
    for (const LostNumber& each : found) {
        Program asked = *program;
        asked.domain.mask->formula = each.is_lost;
        const Field values =
            std::move(run_plan(plan_mask(asked), interpreted(grid), context(0), grid, *team)[0]);
        const auto place = first_cell(values, nullptr, [](double value) { return value > 0; });
        if (!place) continue;
        return control.warn(fmt::format(
            "the mask of the domain: {} is not a number at {}, which is outside by it",
            script->sources.text(each.span), place_in_words(place->column, place->row)));
    }
}

}  // namespace cascade
