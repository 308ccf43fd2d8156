// Constants: what can be computed while a script is checked, in double precision.
#include "lang/check_expression.h"

#include <cmath>

namespace cascade::checking {

namespace {

double truth(bool value) { return value ? 1.0 : 0.0; }

std::optional<double> fold_operator(Function function, double a, double b) {
    switch (function) {
        case Function::logical_or: return truth(a != 0 || b != 0);
        case Function::logical_and: return truth(a != 0 && b != 0);
        case Function::logical_not: return truth(a == 0);
        case Function::less: return truth(a < b);
        case Function::less_equal: return truth(a <= b);
        case Function::greater: return truth(a > b);
        case Function::greater_equal: return truth(a >= b);
        case Function::equal: return truth(a == b);
        case Function::not_equal: return truth(a != b);
        case Function::add: return a + b;
        case Function::subtract: return a - b;
        case Function::multiply: return a * b;
        case Function::divide: return a / b;
        case Function::negate: return -a;
        case Function::power: return std::pow(a, b);
        default: return std::nullopt;
    }
}

}  // namespace

std::optional<double> fold(Function function, double a, double b, double c) {
    switch (function) {
        case Function::if_: return a != 0 ? b : c;
        case Function::min: return std::isnan(a) || a < b ? a : b;
        case Function::max: return std::isnan(a) || a > b ? a : b;
        case Function::abs: return std::abs(a);
        case Function::sqrt: return std::sqrt(a);
        case Function::exp: return std::exp(a);
        case Function::log: return std::log(a);
        case Function::sin: return std::sin(a);
        case Function::cos: return std::cos(a);
        case Function::tanh: return std::tanh(a);
        default: return fold_operator(function, a, b);
    }
}

std::optional<double> check_constant(Workspace& work, const ast::Script& script,
                                     ast::Expression expression, std::string_view subject) {
    Scope scope;
    scope.place = Place::constant;
    scope.subject = subject;
    const auto checked = check_number(work, script, expression, scope);
    return checked ? checked->constant : std::nullopt;
}

}  // namespace cascade::checking
