// The rules of calculus, from the column `slope` of lang/vocabulary/elementary.def.
#include "lang/calculus/derivative_rules.h"

namespace cascade {

namespace {

/// Lets rules be written like formulas on paper.
struct Term {
    Algebra* algebra;
    NodeId id;

    Term call(Function function) const { return {algebra, algebra->call(function, {id})}; }
    Term call(Function function, Term b) const {
        return {algebra, algebra->call(function, {id, b.id})};
    }
    Term number(double value) const { return {algebra, algebra->number(value)}; }
};
Term operator+(Term a, Term b) { return {a.algebra, a.algebra->sum(a.id, b.id)}; }
Term operator-(Term a, Term b) { return {a.algebra, a.algebra->difference(a.id, b.id)}; }
Term operator*(Term a, Term b) { return {a.algebra, a.algebra->product(a.id, b.id)}; }
Term operator/(Term a, Term b) { return {a.algebra, a.algebra->quotient(a.id, b.id)}; }
Term operator-(Term a) { return {a.algebra, a.algebra->negative(a.id)}; }
Term operator<(Term a, Term b) { return a.call(Function::less, b); }
Term operator>(Term a, Term b) { return a.call(Function::greater, b); }
Term square(Term a) { return a * a; }
Term power(Term a, Term b) { return a.call(Function::power, b); }
Term where(Term condition, Term then, Term otherwise) {
    return {condition.algebra,
            condition.algebra->call(Function::if_, {condition.id, then.id, otherwise.id})};
}
Term sqrt(Term a) { return a.call(Function::sqrt); }
Term cbrt(Term a) { return a.call(Function::cbrt); }
Term hypot(Term a, Term b) { return a.call(Function::hypot, b); }
Term exp(Term a) { return a.call(Function::exp); }
Term log(Term a) { return a.call(Function::log); }
Term sin(Term a) { return a.call(Function::sin); }
Term cos(Term a) { return a.call(Function::cos); }
Term tan(Term a) { return a.call(Function::tan); }
Term sinh(Term a) { return a.call(Function::sinh); }
Term cosh(Term a) { return a.call(Function::cosh); }
Term tanh(Term a) { return a.call(Function::tanh); }
Term floor(Term a) { return a.call(Function::floor); }

Term clamp_slope(Term v, Term low, Term high, std::size_t n) {
    const Term zero = v.number(0), one = v.number(1), is_low = v < low;
    const Term is_high = v > high;
    if (n == 0) return where(is_low, zero, where(is_high, zero, one));
    return n == 1 ? where(is_low, one, zero) : where(is_low, zero, where(is_high, one, zero));
}

/// The derivative of 3 p² − 2 p³ with p = (v − a) / (b − a) inside 0 … 1. There is no rule for a
/// and b.
std::optional<Term> smooth_step_slope(Term a, Term b, Term v, std::size_t n) {
    if (n != 2) return std::nullopt;
    const Term p = (v - a) / (b - a), zero = v.number(0), one = v.number(1);
    const Term inside = (p > zero).call(Function::logical_and, p < one);
    return where(inside, v.number(6) * p * (one - p) / (b - a), zero);
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
        // Mean + spread · noise, where |noise| ≤ 1.
        case Function::random: return one;
        default: return std::nullopt;
    }
}

}  // namespace

std::optional<NodeId> partial_derivative(Algebra& algebra, const Node& call, std::size_t n) {
    const Node copy = call;  // A copy, since `call` may refer into the algebra's list, which grows.
    const auto slope = slope_of(algebra, copy, n);
    if (!slope) return std::nullopt;
    return slope->id;
}

}  // namespace cascade
