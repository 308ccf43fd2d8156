// Checks the ranges of quantities, and the texts that describe a system.
#include "lang/check/systems/check_systems.h"
#include "lang/check/expressions/check_expression.h"

#include <fmt/format.h>

namespace cascade::checking {

bool take_text(System& system, const Declaration& declaration) {
    const ast::Statement& statement = *declaration.statement;
    if (!statement.index.empty() || statement.values.size() != 1) return false;
    const auto& value = declaration.script->expressions[statement.values[0].root].node;
    const auto* text = std::get_if<ast::Text>(&value);
    if (text == nullptr) return false;
    std::string* target = declaration.name == "title"   ? &system.title
                          : declaration.name == "cite"  ? &system.cite
                          : declaration.name == "about" ? &system.about
                                                        : nullptr;
    if (target != nullptr) *target = text->value;
    return target != nullptr;
}

void check_range(Workspace& work, const Declaration& declaration, Quantity& quantity,
                 std::optional<double> value) {
    const ast::Range& written = *declaration.range;
    const ast::Script& script = *declaration.range_script;
    const auto low = check_constant(work, script, written.low, "the end of a range", std::nullopt);
    const auto high =
        check_constant(work, script, written.high, "the end of a range", std::nullopt);
    if (!low || !high) return;
    ParameterRange range{*low, *high, std::nullopt};
    if (written.step) {
        range.step =
            check_constant(work, script, *written.step, "the step of a range", std::nullopt);
        if (!range.step) return;
    }
    if (!(*low < *high)) {
        work.diagnostics.error(written.span, "the first end of a range must be below the second");
    } else if (range.step && !(*range.step > 0 && *range.step <= *high - *low)) {
        work.diagnostics.error(written.span,
                               "the step of a range must be above 0 and at most the length of "
                               "the range");
    } else {
        quantity.range = range;
        const ast::Expression default_value = declaration.value();
        warn_outside(work, quantity, value,
                     declaration.script->expressions[default_value.root].span);
    }
}

void warn_outside(Workspace& work, const Quantity& quantity, std::optional<double> value,
                  Span span) {
    if (!quantity.range || !value) return;
    const auto [low, high, step] = *quantity.range;
    if (*value >= low && *value <= high) return;
    work.diagnostics.warning(span,
                             fmt::format("{} is {:.7g}, outside of its range {:.7g} .. {:.7g}",
                                         quantity.name, *value, low, high));
}

}  // namespace cascade::checking
