// Evaluates numbers that must be known while a script is checked.
#include "lang/check/expressions/check_expression.h"
#include "lang/check/expressions/measures.h"

#include <fmt/format.h>

namespace cascade::checking {

bool check_unit_of_constant(Workspace& work, const Formula& formula, std::string_view subject,
                            const Dimension& dimension) {
    if (work.units.empty()) return true;
    std::vector<Contradiction> found;
    const auto nothing = [](const Node&) { return Measure{}; };
    const Measure measure =
        measure_of(formula, {work.units, work.measured, nothing, Measure::Kind::plain}, found);
    const Span span = formula.nodes.back().span;
    if (!found.empty()) {
        report(work, found.front().span,
               fmt::format("this is {}, and what it belongs with is {}",
                           words_of_dimension(work.units, found.front().right),
                           words_of_dimension(work.units, found.front().left)),
               "");
        return false;
    }
    if (!measure.is_known() || measure.dimension == dimension) return true;
    const std::string unit = work.units.name_of(dimension);
    if (unit.empty()) {
        report(work, span, fmt::format("{} has no unit", subject), "write the number alone");
    } else {
        report(work, span,
               fmt::format("this is {}, but {} is {}",
                           words_of_dimension(work.units, measure.dimension), subject,
                           words_of_dimension(work.units, dimension)),
               fmt::format("such as '1 {}'", unit));
    }
    return false;
}

std::optional<double> check_constant(Workspace& work, const ast::Script& script,
                                     ast::Expression expression, std::string_view subject,
                                     std::optional<Dimension> dimension) {
    Scope scope;
    scope.context = Context::constant;
    scope.subject = subject;
    const auto checked = check_number(work, script, expression, scope);
    if (!checked) return std::nullopt;
    if (dimension && !check_unit_of_constant(work, checked->formula, subject, *dimension)) {
        return std::nullopt;
    }
    return checked->constant;
}

}  // namespace cascade::checking
