// Checks the formulas of a `system` or `cells` block: values, definitions, rates, bounds and
// settings.
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_time.h"
#include "lang/check/names/note_uses.h"
#include "lang/check/systems/system_checker.h"
#include "lang/check/systems/typed_definitions.h"
#include "lang/program/order.h"
#include "lang/check/expressions/read_setting.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

std::vector<const Declaration*> SystemChecker::RateStatements::all() const {
    std::vector<const Declaration*> statements = terms;
    if (assignment != nullptr) statements.insert(statements.begin(), assignment);
    return statements;
}

void SystemChecker::report_type(const Declaration& declaration, const CheckedExpression& checked,
                                Context context, ValueType wanted) {
    const ValueType type = checked.type();
    const Span span = checked.formula.nodes.back().span;
    if (wanted == ValueType::vector) {
        work_.diagnostics.error(span, "a vector is needed here", vectors_are(is_cells()));
        return;
    }
    const TypeWords words = words_of(type, is_cells());
    const bool is_parameter = context == Context::value && !is_cells() &&
                              (type == ValueType::vector || type == ValueType::tensor);
    work_.diagnostics.error(span, fmt::format("{} is not a number", words.name),
                            is_parameter
                                ? fmt::format("a definition can hold it: {} = …", declaration.name)
                                : std::string(words.hint));
}

/// Checks the value of a declaration, which is a number or a vector. Reports errors.
std::optional<CheckedExpression> SystemChecker::check_value(const Declaration& declaration,
                                                            Context context, ValueType type) {
    if (!has_one_value(work_, declaration)) return std::nullopt;
    const Scope where = scope(context, declaration);
    const ast::Expression value = declaration.value();
    auto checked = check_expression(work_, *declaration.script, value, where);
    if (checked && checked->type() != type) {
        report_type(declaration, *checked, context, type);
        return std::nullopt;
    }
    if (checked) mark_reads(work_, checked->formula, index_);
    return checked;
}

void SystemChecker::check_values() {
    for (const ItemId id : values_.ids()) {
        if (values_[id] == nullptr) continue;
        Quantity& quantity = system().quantities[id];
        auto checked = check_value(*values_[id], Context::value);
        if (checked) quantity.start = std::move(checked->formula);
        if (values_[id]->range == nullptr) continue;
        // Cells have a radius even if the system gives it no rate, so the radius may have a range.
        // The range is written after the starting value of the radius.
        const bool is_radius = is_cells() && id == system().cells->radius;
        if (quantity.is_species && !is_radius) {
            work_.diagnostics.error(values_[id]->range->span, "only a parameter can have a range",
                                    fmt::format("'{}' is a species", quantity.name));
        } else {
            check_range(work_, *values_[id], quantity, checked ? checked->constant : std::nullopt);
        }
    }
}

void SystemChecker::check_definitions() {
    check_typed_definitions(work_, index_, Context::rate, definitions_);
}

namespace {

/// Adds a term to a sum of the same type.
void superpose(Formula& sum, Formula term) {
    if (sum.nodes.empty()) {
        sum = std::move(term);
        return;
    }
    const NodeId before = NodeId(sum.nodes.size() - 1);
    for (Node& node : term.nodes) {
        for (NodeId& operand : node.reads()) {
            operand = NodeId(operand.index() + before.index() + 1);
        }
        sum.nodes.push_back(node);
    }
    Node addition;
    addition.kind = Call();
    addition.function = Function::add;
    addition.span = sum.nodes.back().span;
    addition.type = sum.nodes.back().type;
    addition.operands = {before, NodeId(sum.nodes.size() - 1)};
    addition.operand_count = 2;
    sum.nodes.push_back(addition);
}

}  // namespace

Formula SystemChecker::sum_of(const RateStatements& rate, ValueType type) {
    Formula sum;
    for (const Declaration* declaration : rate.all()) {
        auto checked = check_value(*declaration, Context::rate, type);
        if (checked) superpose(sum, std::move(checked->formula));
    }
    return sum;
}

void SystemChecker::check_rates() {
    system().rates.resize(system().quantities.size());
    for (const ItemId id : rates_.ids()) system().rates[id] = sum_of(rates_[id]);
    if (is_cells()) check_rates_of_cells();
}

void SystemChecker::check_invariants() {
    for (const Declaration* declaration : invariants_) {
        const Meaning* meaning = find(work_.names[index_], declaration->name);
        if (meaning != nullptr && meaning->has_error) continue;
        const auto species = find_species(work_, index_, declaration->name);
        if (!species) {
            report_not_species(work_, index_, declaration->name, declaration->span());
            continue;
        }
        note_use(work_, declaration->span(), index_, *species);
        auto checked = check_value(*declaration, Context::bound);
        if (!checked) continue;
        system().invariants.push_back({*species,
                                       declaration->kind() == ast::StatementKind::at_least,
                                       std::move(checked->formula)});
    }
}

void SystemChecker::check_settings() {
    Settings settings;
    // The level of the last system that sets how stages end: by iterations, a duration or a
    // condition. Ends that its bases set have no effect.
    std::uint32_t level_of_end = 0;
    for (const Declaration* declaration : settings_) {
        if (is_end_setting(declaration->name) || declaration->name == "until") {
            level_of_end = std::max(level_of_end, declaration->level);
        }
    }
    for (const Declaration* declaration : settings_) {
        if (is_end_setting(declaration->name) && declaration->level < level_of_end) continue;
        check_setting(work_, *declaration->script, *declaration->statement,
                      scope(Context::value, *declaration), settings);
    }
    for (const auto* formula :
         {&settings.frozen, &settings.speed, &settings.show, &settings.time.until}) {
        if (*formula) mark_reads(work_, **formula, index_);
    }
    system().settings = std::move(settings);
}

}  // namespace cascade::checking
