// Chooses the units in which a script computes from the units that the script contains.
#include "lang/syntax/script_units.h"

#include "lang/syntax/kept_spellings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace cascade {

namespace {

constexpr std::array<std::string_view, base_quantity_count> default_names{"m",  "s", "mol",
                                                                          "kg", "A", "K"};
/// The order in which base quantities come in the name of a unit. A quantity comes earlier if its
/// unit may also measure other quantities: amount (uM) comes before length (m).
constexpr std::array order_of_names{BaseQuantity::current,     BaseQuantity::amount,
                                    BaseQuantity::temperature, BaseQuantity::mass,
                                    BaseQuantity::length,      BaseQuantity::time};

std::size_t index_of(BaseQuantity quantity) { return static_cast<std::size_t>(quantity); }

/// Calls visit(text) for each unit in the nodes [first, last].
template <typename Visit>
void for_each_unit(const ast::Script& script, ast::ExprId first, ast::ExprId last,
                   const Visit& visit) {
    for (ast::ExprId id = first; id <= last && id < script.expressions.size(); ++id) {
        const auto* const call = std::get_if<ast::Call>(&script.expressions[id].node);
        if (call != nullptr && is_unit_call(call->function.text)) {
            visit(text_of_unit_call(call->function.text));
        }
    }
}

/// Calls visit(text) for each unit in the values of these statements.
template <typename Visit>
void for_each_unit_of(const ast::Script& script, bool is_of_domain,
                      std::initializer_list<std::string_view> names, const Visit& visit) {
    for (const std::string_view name : names) {
        for (const ast::Block& block : script.blocks) {
            if ((block.kind == ast::BlockKind::domain) != is_of_domain) continue;
            for (const ast::Statement& statement : block.statements) {
                if (statement.name.text != name) continue;
                for (const ast::Expression value : statement.values) {
                    for_each_unit(script, value.first, value.root, visit);
                }
            }
        }
    }
}

std::string with_power(const std::string& name, double power) {
    const bool has_sign = name.find_first_of("*/") != std::string::npos;
    const std::string base = has_sign ? "(" + name + ")" : name;
    return power == 1 ? base : fmt::format("{}^{:.4g}", base, power);
}

/// The name and the value of the concentration in a unit, such as mol/m^3 in mol/m^3/s. The name is
/// empty if the unit contains no concentration.
std::pair<std::string, Unit> concentration_in(std::string_view text) {
    const Dimension wanted =
        Dimension::of(BaseQuantity::amount) / Dimension::of(BaseQuantity::length, 3);
    Unit part;
    // The names of the factors above and below the fraction line.
    std::array<std::string, 2> names;
    for (const UnitFactor& factor : factors_of_unit(text)) {
        Unit unit = *unit_named(factor.name);
        Dimension others = unit.dimension;
        others.sixths[index_of(BaseQuantity::length)] = 0;
        others.sixths[index_of(BaseQuantity::amount)] = 0;
        if (!others.is_none() || unit.dimension.is_none()) continue;
        part = part * to_power(unit, factor.power);
        std::string& name = names[factor.power > 0 ? 0 : 1];
        const std::string separator = factor.power > 0 ? "*" : "/";
        name += (name.empty() ? "" : separator) +
                with_power(std::string(factor.name), std::abs(factor.power));
    }
    if (part.dimension[BaseQuantity::amount] < 0) {
        part = Unit{} / part;
        std::swap(names[0], names[1]);
    }
    if (part.dimension != wanted) return {};
    return {names[0] + (names[1].empty() ? "" : "/" + names[1]), part};
}

}  // namespace

ScriptUnits::ScriptUnits() {
    for (std::size_t k = 0; k < base_quantity_count; ++k) {
        const auto quantity = static_cast<BaseQuantity>(k);
        bases_[k].name = default_names[k];
        bases_[k].dimension = bases_[k].size.dimension = Dimension::of(quantity);
    }
}

bool ScriptUnits::empty() const {
    return std::ranges::none_of(known_, [](bool is_known) { return is_known; });
}

/// Looks in a unit for the first factor that measures only `quantity`, such as um or h, and takes
/// it as the script's unit of `quantity`, unless a factor has been taken before.
void ScriptUnits::take_plain(std::string_view text, BaseQuantity quantity) {
    Base& base = bases_[index_of(quantity)];
    for (const UnitFactor& factor : factors_of_unit(text)) {
        const Unit unit = *unit_named(factor.name);
        if (base.is_given || unit.dimension != Dimension::of(quantity)) continue;
        base = {std::string(factor.name), unit.dimension, unit, true};
    }
}

/// Takes factors such as uM, kg or mV as the script's units of all quantities except length and
/// time.
void ScriptUnits::take_others(std::string_view text) {
    const auto [name, concentration] = concentration_in(text);
    Base& amount = bases_[index_of(BaseQuantity::amount)];
    if (!name.empty() && !amount.is_given) {
        const Dimension volume = Dimension::of(BaseQuantity::length, 3);
        amount = {name, concentration.dimension, concentration * size_of(volume), true};
    }
    for (const UnitFactor& factor : factors_of_unit(text)) {
        const Unit unit = *unit_named(factor.name);
        std::size_t last = 0;
        for (std::size_t k = index_of(BaseQuantity::amount); k < base_quantity_count; ++k) {
            if (unit.dimension.sixths[k] != 0 && !bases_[k].is_given) last = k;
        }
        if (last == 0 || std::abs(unit.dimension.sixths[last]) != 6) continue;
        const int power = unit.dimension.sixths[last] / 6;
        Dimension others = unit.dimension;
        others.sixths[last] = 0;
        bases_[last].name = factor.name;
        bases_[last].dimension = unit.dimension;
        bases_[last].size = to_power(unit / size_of(others), power);
        for (std::size_t k = 0; k < base_quantity_count; ++k) {
            bases_[k].is_given = bases_[k].is_given || unit.dimension.sixths[k] != 0;
        }
    }
}

void ScriptUnits::note_known(std::string_view text) {
    for (const UnitFactor& factor : factors_of_unit(text)) {
        const Dimension dimension = unit_named(factor.name)->dimension;
        for (std::size_t k = 0; k < base_quantity_count; ++k) {
            const auto quantity = static_cast<BaseQuantity>(k);
            const bool is_plain = dimension == Dimension::of(quantity);
            if (dimension.sixths[k] == 0) continue;
            known_[k] = known_[k] || is_plain || quantity != BaseQuantity::length;
        }
    }
}

/// The size of the unit that a dimension has in this script. The powers of the dimension must be
/// whole.
Unit ScriptUnits::size_of(const Dimension& dimension) const {
    Unit size;
    for (std::size_t k = 0; k < base_quantity_count; ++k) {
        size = size * to_power(bases_[k].size, dimension.sixths[k] / 6);
    }
    return size;
}

double ScriptUnits::convert(double number, const Unit& unit) const {
    return in_base_units(number, unit / size_of(unit.dimension));
}

std::string ScriptUnits::name_of(const Dimension& dimension) const {
    std::string above, below;
    Dimension rest = dimension;
    for (const BaseQuantity quantity : order_of_names) {
        const Base& base = bases_[index_of(quantity)];
        if (rest[quantity] == 0) continue;
        const double power = static_cast<double>(rest[quantity]) / base.dimension[quantity];
        for (std::size_t k = 0; k < base_quantity_count; ++k) {
            rest.sixths[k] =
                static_cast<std::int16_t>(rest.sixths[k] - base.dimension.sixths[k] * power);
        }
        const bool is_alone = power == 1 && above.empty();
        if (power > 0)
            above +=
                is_alone ? base.name : (above.empty() ? "" : "*") + with_power(base.name, power);
        else below += "/" + with_power(base.name, -power);
    }
    return above.empty() && !below.empty() ? "1" + below : above + below;
}

ScriptUnits units_of(const ast::Script& script) {
    ScriptUnits units;
    if (script.expressions.empty()) return units;
    const auto take = [&](BaseQuantity quantity) {
        return [&units, quantity](std::string_view text) { units.take_plain(text, quantity); };
    };
    const auto last = static_cast<ast::ExprId>(script.expressions.size() - 1);
    for_each_unit_of(script, true, {"extent", "spacing"}, take(BaseQuantity::length));
    for_each_unit_of(script, false, {"duration", "every", "speed", "largest_step"},
                     take(BaseQuantity::time));
    for_each_unit(script, 0, last, take(BaseQuantity::length));
    for_each_unit(script, 0, last, take(BaseQuantity::time));
    for_each_unit(script, 0, last, [&](std::string_view text) { units.take_others(text); });
    for_each_unit(script, 0, last, [&](std::string_view text) { units.note_known(text); });
    return units;
}

std::string_view unit_text_of(const ast::Script& script, ast::Expression expression) {
    ast::ExprId root = expression.root;
    if (const auto* const unary = std::get_if<ast::Unary>(&script.expressions[root].node)) {
        if (unary->op == Function::negate) root = unary->operand;
    }
    const auto* const call = std::get_if<ast::Call>(&script.expressions[root].node);
    const bool is_unit = call != nullptr && is_unit_call(call->function.text);
    return is_unit ? text_of_unit_call(call->function.text) : std::string_view();
}

std::string_view unit_of_value(const ast::Script& script, std::string_view stage,
                               std::string_view name) {
    for (const ast::FunctionDefinition& function : script.functions) {
        const bool is_it = function.is_constant && stage.empty() && function.name.text == name;
        if (is_it) return unit_text_of(script, function.body);
    }
    for (const bool is_stage : {true, false}) {
        for (const ast::Block& block : script.blocks) {
            const bool is_of_stage =
                block.kind == ast::BlockKind::stage || block.kind == ast::BlockKind::classic_stage;
            const bool is_other =
                !stage.empty() && block.name.text != stage && block.base.text != stage;
            if (is_of_stage != is_stage || (is_stage && is_other)) continue;
            for (const ast::Statement& each : block.statements) {
                if (each.name.text != name || each.values.empty()) continue;
                const std::string_view unit = unit_text_of(script, each.values[0]);
                if (!unit.empty()) return unit;
            }
        }
    }
    return {};
}

void give_unit(ast::Script& script, ast::Expression& expression, std::string_view unit) {
    if (unit.empty() || expression.root + 1 != script.expressions.size()) return;
    const auto& node = script.expressions[expression.root].node;
    const auto* const unary = std::get_if<ast::Unary>(&node);
    const bool has_sign =
        unary != nullptr && unary->op == Function::negate &&
        std::holds_alternative<ast::Number>(script.expressions[unary->operand].node);
    if (!has_sign && !std::holds_alternative<ast::Number>(node)) return;
    const Span span = script.expressions[expression.root].span;
    const auto argument = static_cast<std::uint32_t>(script.arguments.size());
    script.arguments.push_back(expression.root);
    const std::string_view name = kept_spelling(fmt::format(" {}", unit));
    script.expressions.push_back({span, ast::Call{{span, name}, argument, 1}});
    ++expression.root;
}

MeasuredSpans::MeasuredSpans(const ast::Script& script) {
    for (const ast::Expr& part : script.expressions) {
        const auto key = std::tuple(part.span.source, part.span.begin, part.span.end);
        if (const auto* const call = std::get_if<ast::Call>(&part.node)) {
            if (!is_unit_call(call->function.text)) continue;
            dimensions_[key] = unit_of(text_of_unit_call(call->function.text)).dimension;
        }
        // domain.x, domain.width and the other places and lengths of the domain are lengths.
        const auto* const length = std::get_if<ast::Qualified>(&part.node);
        const auto* const place = std::get_if<ast::Component>(&part.node);
        const auto is_domain = [&](ast::ExprId id) {
            const auto* const name = std::get_if<ast::Name>(&script.expressions[id].node);
            return name != nullptr && name->name == "domain";
        };
        if ((length != nullptr && length->stage.text == "domain") ||
            (place != nullptr && is_domain(place->operand))) {
            dimensions_[key] = Dimension::of(BaseQuantity::length);
        }
    }
}

const Dimension* MeasuredSpans::find(Span span) const {
    const auto found = dimensions_.find(std::tuple(span.source, span.begin, span.end));
    return found == dimensions_.end() ? nullptr : &found->second;
}

}  // namespace cascade
