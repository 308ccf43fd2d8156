// Evaluates numbers that must be known while a script is checked.
#include "lang/check/expressions/check_expression.h"

namespace cascade::checking {

std::optional<double> check_constant(Workspace& work, const ast::Script& script,
                                     ast::Expression expression, std::string_view subject) {
    Scope scope;
    scope.context = Context::constant;
    scope.subject = subject;
    const auto checked = check_number(work, script, expression, scope);
    return checked ? checked->constant : std::nullopt;
}

}  // namespace cascade::checking
