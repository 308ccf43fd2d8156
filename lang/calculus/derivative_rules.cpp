// The rules of calculus, taken from the column `slope` of lang/vocabulary/elementary.def.
#include "lang/calculus/derivative_rules.h"

#include "lang/program/terms.h"

namespace cascade {

namespace {

Term clamp_slope(Term v, Term low, Term high, std::size_t n) {
    const Term zero = v.number(0), one = v.number(1), is_low = v < low;
    const Term is_high = v > high;
    if (n == 0) return if_(is_low, zero, if_(is_high, zero, one));
    return n == 1 ? if_(is_low, one, zero) : if_(is_low, zero, if_(is_high, one, zero));
}

/// The derivative of 3 p² − 2 p³ with respect to v, where p = (v − a) / (b − a) is between 0 and 1.
/// There is no rule for the derivatives with respect to a and b.
std::optional<Term> smooth_step_slope(Term a, Term b, Term v, std::size_t n) {
    if (n != 2) return std::nullopt;
    const Term p = (v - a) / (b - a), zero = v.number(0), one = v.number(1);
    const Term is_above = p > zero;
    return if_(logical_and(is_above, p < one), v.number(6) * p * (one - p) / (b - a), zero);
}

std::optional<Term> slope_of(Algebra& algebra, const Node& call, std::size_t n) {
    const Term a{&algebra, call.operands[0]}, b{&algebra, call.operands[1]};
    const Term c{&algebra, call.operands[2]};
    const Term zero = a.number(0), one = a.number(1);
    switch (call.function) {
        // clang-format off
#define CASCADE_ELEMENTARY(id, value, kernel, slope) case Function::id: return slope;
#include "lang/vocabulary/elementary.def"
        // clang-format on
        // The value is mean + spread · noise with |noise| ≤ 1, so 1 bounds both derivatives.
        case Function::random: return one;
        default: return std::nullopt;
    }
}

}  // namespace

std::optional<NodeId> partial_derivative(Algebra& algebra, const Node& call, std::size_t n) {
    // This must be a copy, because `call` may be an element of the algebra's list, which grows.
    const Node copy = call;
    const auto slope = slope_of(algebra, copy, n);
    if (!slope) return std::nullopt;
    return slope->id;
}

}  // namespace cascade
