// Infers the dimension of each value in a stage, and compares the dimensions of the two sides of
// each formula.
#include "lang/check/check_dimensions.h"

#include "lang/check/expressions/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace cascade {

namespace {

using checking::Contradiction;
using checking::Measure;
using checking::MeasureOf;
using checking::words_of_dimension;

const Dimension length_dimension = Dimension::of(BaseQuantity::length);
const Dimension time_dimension = Dimension::of(BaseQuantity::time);

/// The measures of the values of one stage, or of one system that no stage uses.
struct Measures {
    IdVector<ItemId, Measure> items;
    IdVector<DefinitionId, Measure> definitions;
};

class DimensionChecker {
public:
    DimensionChecker(const ast::Script& script, const Program& program)
        : program_(program), units_(units_of(script)), measured_(script) {}

    const ScriptUnits& units() const { return units_; }
    Measure measure_in_stage(const Formula& formula, std::uint32_t stage) {
        return stage < stages_.size() ? measure_in_step(formula, stages_[stage]) : Measure{};
    }
    const std::vector<Measures>& stages() const { return stages_; }
    const std::vector<Contradiction>& found() const { return found_; }

    void run() {
        if (units_.empty()) return;
        for (std::uint32_t k = 0; k < program_.stages.size(); ++k) {
            const Stage& stage = program_.stages[k];
            stages_.push_back(measure(program_.systems[stage.system], stage.items, stage.order));
            check_against_system(k);
            check_stage(k);
        }
        for (const System& system : program_.systems) {
            const bool is_used = std::ranges::any_of(program_.stages, [&](const Stage& stage) {
                return &program_.systems[stage.system] == &system;
            });
            if (is_used || system.built_in) continue;
            IdVector<ItemId, Formula> starts;
            for (const Quantity& quantity : system.quantities) starts.push_back(quantity.start);
            starts.resize(system.item_count());
            // Without a stage, items have no order, so each item is visited twice. On the second
            // visit, the measures of all names are known.
            std::vector<ItemId> order;
            for (int pass = 0; pass < 2; ++pass) {
                for (const ItemId item : starts.ids()) order.push_back(item);
            }
            check_system(system, measure(system, starts, order));
        }
    }

private:
    MeasureOf leaves(const Measures& own, Measure::Kind number) const {
        return {units_, measured_, [this, &own](const Node& node) { return leaf(own, node); },
                number};
    }
    Measure leaf(const Measures& own, const Node& node) const {
        if (const auto* item = node.as<ItemId>()) return own.items[*item];
        if (const auto* id = node.as<DefinitionId>()) {
            return *id < own.definitions.next() ? own.definitions[*id] : Measure{};
        }
        if (const auto* rate = node.as<Rate>()) return per_time(own.items[rate->species]);
        const auto* sensed = node.as<SensedItem>();
        const auto* item = sensed != nullptr ? &sensed->item : node.as<StageItem>();
        if (item == nullptr || item->stage >= stages_.size()) return {};
        return stages_[item->stage].items[item->item];
    }
    Measure per_time(const Measure& measure) const {
        if (!measure.is_known() || !units_.knows(BaseQuantity::time)) return {};
        return Measure::of(measure.dimension / time_dimension);
    }

    Measures measure(const System& system, const IdVector<ItemId, Formula>& items,
                     const std::vector<ItemId>& order) {
        Measures own;
        own.items.resize(items.size());
        for (const ItemId item : order) {
            if (items[item].nodes.empty()) continue;
            own.items[item] = measure_of(items[item], leaves(own, Measure::Kind::plain), found_);
            // If the value is a plain number, the author may have left out its unit.
            if (!own.items[item].is_known()) own.items[item] = {};
        }
        for (const Definition& definition : system.definitions) {
            if (definition.formula.nodes.empty()) own.definitions.push_back({});
            else own.definitions.push_back(measure_in_step(definition.formula, own));
        }
        return own;
    }
    Measure measure_in_step(const Formula& formula, const Measures& own) {
        return measure_of(formula, leaves(own, Measure::Kind::any), found_);
    }

    /// Compares two measures that must be equal. `first` and `second` are the source locations of
    /// the parts that have them.
    void compare(const Measure& expected, Span first, const Measure& other, Span second,
                 std::string what = {}) {
        if (!expected.is_known() || !other.is_known()) return;
        if (expected.dimension == other.dimension) return;
        found_.push_back(
            {second, first, second, expected.dimension, other.dimension, std::move(what)});
    }

    /// Compares the measures of a stage's values with the measures of the system's default values.
    void check_against_system(std::uint32_t index) {
        const Stage& stage = program_.stages[index];
        const System& system = program_.systems[stage.system];
        const Measures& own = stages_[index];
        for (const ItemId item : system.quantities.ids()) {
            const Formula& start = system.quantities[item].start;
            if (start.nodes.empty()) continue;
            std::vector<Contradiction> known_already;
            const Measure declared =
                measure_of(start, leaves(own, Measure::Kind::plain), known_already);
            compare(declared, start.nodes.back().span, own.items[item],
                    stage.items[item].nodes.back().span);
        }
    }

    void check_stage(std::uint32_t index) {
        const Stage& stage = program_.stages[index];
        const System& system = program_.systems[stage.system];
        const Measures& own = stages_[index];
        check_system(system, own);
        const Formula& speed = stage.items[system.speed_item()];
        if (!speed.nodes.empty()) {
            const Measure measure = own.items[system.speed_item()];
            if (measure.is_known() && measure.dimension != time_dimension) {
                const Span span = speed.nodes.back().span;
                found_.push_back({span, span, {}, measure.dimension, time_dimension});
            }
        }
        if (stage.time.until) measure_in_step(*stage.time.until, own);
        const auto species = system.species();
        for (const SpeciesId id : stage.sides.ids()) {
            const ItemId item = species[id];
            for (const SideSetting& side : stage.sides[id]) {
                check_side(side, system.quantities[item], own.items[item], own);
            }
        }
    }

    void check_side(const SideSetting& side, const Quantity& quantity, Measure of,
                    const Measures& own) {
        if (side.value.nodes.empty() || !of.is_known()) return;
        const bool is_flux = side.kind == SideKind::flux;
        const bool is_slope = side.kind == SideKind::slope;
        if (!units_.knows(BaseQuantity::length) && (is_flux || is_slope)) return;
        if (!units_.knows(BaseQuantity::time) && is_flux) return;
        if (is_slope) of = Measure::of(of.dimension / length_dimension);
        if (is_flux) of = Measure::of(of.dimension * length_dimension / time_dimension);
        const Measure value = measure_of(side.value, leaves(own, Measure::Kind::plain), found_);
        const std::string what = fmt::format("the {} of '{}'",
                                             is_flux    ? "flux"
                                             : is_slope ? "slope"
                                                        : "value",
                                             quantity.name);
        compare(of, quantity.span, value, side.value.nodes.back().span, what);
    }

    void check_system(const System& system, const Measures& own) {
        for (const ItemId item : system.rates.ids()) {
            const Formula& rate = system.rates[item];
            if (rate.nodes.empty()) continue;
            compare(per_time(own.items[item]), system.quantities[item].span,
                    measure_in_step(rate, own), rate.nodes.back().span,
                    fmt::format("the rate of '{}'", system.quantities[item].name));
        }
        for (const Invariant& invariant : system.invariants) {
            compare(own.items[invariant.species], system.quantities[invariant.species].span,
                    measure_in_step(invariant.bound, own), invariant.bound.nodes.back().span);
        }
    }

    const Program& program_;
    ScriptUnits units_;
    MeasuredSpans measured_;
    std::vector<Measures> stages_;
    std::vector<Contradiction> found_;
};

/// The text of a part of the script, for messages.
std::string text_of_part(const Sources& sources, Span span) {
    constexpr std::size_t longest = 40;
    std::string text(sources.text(span).substr(0, longest + 1));
    text.resize(std::min(text.find_first_of("\r\n#"), text.size()));
    if (text.size() > longest) text = text.substr(0, longest) + "…";
    return text;
}

}  // namespace

void check_dimensions(const ast::Script& script, const Sources& sources, const Program& program,
                      Diagnostics& diagnostics) {
    DimensionChecker checker(script, program);
    checker.run();
    std::set<std::pair<SourceId, std::uint32_t>> reported;
    for (const Contradiction& each : checker.found()) {
        if (!reported.emplace(each.span.source, each.span.begin).second) continue;
        const std::string left = words_of_dimension(checker.units(), each.left);
        const std::string right = words_of_dimension(checker.units(), each.right);
        const std::string first =
            each.what.empty() ? fmt::format("'{}'", text_of_part(sources, each.first)) : each.what;
        if (each.second == Span{}) {
            diagnostics.error(each.span,
                              fmt::format("{} is {}, but must be {} here", first, left, right));
            continue;
        }
        diagnostics.error(each.span,
                          fmt::format("{} is {}, but '{}' is {}", first, left,
                                      text_of_part(sources, each.second), right),
                          "a sum, a comparison or a rate needs the same unit on both sides");
    }
}

std::string unit_of_formula(const ast::Script& script, const Program& program, std::uint32_t stage,
                            const Formula& formula) {
    DimensionChecker checker(script, program);
    checker.run();
    const Measure measure = checker.measure_in_stage(formula, stage);
    return measure.is_known() ? checker.units().name_of(measure.dimension) : "";
}

ProgramUnits units_of_program(const ast::Script& script, const Program& program) {
    DimensionChecker checker(script, program);
    checker.run();
    ProgramUnits units{checker.units(), {}};
    for (const Stage& stage : program.stages) {
        auto& items = units.items.emplace_back();
        items.resize(stage.items.size());
        if (checker.stages().empty()) continue;
        const Measures& measures = checker.stages()[units.items.size() - 1];
        for (const ItemId item : items.ids()) {
            if (measures.items[item].is_known()) items[item] = measures.items[item].dimension;
        }
    }
    return units;
}

}  // namespace cascade
