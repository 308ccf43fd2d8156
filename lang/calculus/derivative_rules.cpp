// The rules of calculus.
#include "lang/calculus/derivative_rules.h"

namespace cascade {

namespace {

/// Formulas of a rule, written as they are on paper.
struct Term {
    FormulaBuilder* builder;
    PartId id;
};
Term operator+(Term a, Term b) { return {a.builder, a.builder->add(a.id, b.id)}; }
Term operator-(Term a, Term b) { return {a.builder, a.builder->subtract(a.id, b.id)}; }
Term operator*(Term a, Term b) { return {a.builder, a.builder->multiply(a.id, b.id)}; }
Term operator/(Term a, Term b) { return {a.builder, a.builder->divide(a.id, b.id)}; }
Term operator-(Term a) { return {a.builder, a.builder->negate(a.id)}; }

class Rules {
public:
    Rules(FormulaBuilder& builder, const Node& node) : builder_(builder), node_(node) {}

    /// ∂(the part)/∂(its operand n), where the function has a rule for it.
    std::optional<PartId> partial(std::size_t n) {
        const auto term = operand_count(node_) == 1 ? of_one()
                          : operand_count(node_) == 2 ? of_two(n)
                                                      : of_three(n);
        if (!term) return std::nullopt;
        return term->id;
    }

private:
    Term operand(std::size_t n) const { return {&builder_, node_.operands[n]}; }
    Term number(double value) const { return {&builder_, builder_.number(value)}; }
    Term call(Function function, Term a) const { return {&builder_, builder_.call(function, {a.id})}; }
    Term call(Function function, Term a, Term b) const {
        return {&builder_, builder_.call(function, {a.id, b.id})};
    }
    Term square(Term a) const { return a * a; }
    Term where(Term condition, Term then, Term otherwise) const {
        return {&builder_, builder_.choose(condition.id, then.id, otherwise.id)};
    }

    std::optional<Term> of_one() {
        const Term a = operand(0);
        const Term one = number(1);
        switch (node_.function) {
            case Function::negate: return number(-1);
            case Function::logical_not:
            case Function::sign:
            case Function::floor:
            case Function::ceil:
            case Function::round: return number(0);
            case Function::abs: return where(call(Function::less, a, number(0)), number(-1), one);
            case Function::sqrt: return number(0.5) / call(Function::sqrt, a);
            case Function::cbrt: return one / (number(3) * square(call(Function::cbrt, a)));
            case Function::exp: return call(Function::exp, a);
            case Function::log: return one / a;
            case Function::sin: return call(Function::cos, a);
            case Function::cos: return -call(Function::sin, a);
            case Function::tan: return one + square(call(Function::tan, a));
            case Function::asin: return one / call(Function::sqrt, one - square(a));
            case Function::acos: return -(one / call(Function::sqrt, one - square(a)));
            case Function::atan: return one / (one + square(a));
            case Function::sinh: return call(Function::cosh, a);
            case Function::cosh: return call(Function::sinh, a);
            case Function::tanh: return one - square(call(Function::tanh, a));
            default: return std::nullopt;
        }
    }

    std::optional<Term> of_two(std::size_t n) {
        const Term a = operand(0), b = operand(1);
        const Term zero = number(0), one = number(1);
        switch (node_.function) {
            case Function::logical_or:
            case Function::logical_and:
            case Function::less:
            case Function::less_equal:
            case Function::greater:
            case Function::greater_equal:
            case Function::equal:
            case Function::not_equal:
            case Function::step: return zero;
            case Function::add: return one;
            case Function::subtract: return number(n == 0 ? 1 : -1);
            case Function::multiply: return n == 0 ? b : a;
            case Function::divide: return n == 0 ? one / b : -(a / square(b));
            case Function::power:
            case Function::pow: return power(a, b, n);
            case Function::min: return where(call(Function::less, b, a), number(n == 0 ? 0 : 1),
                                             number(n == 0 ? 1 : 0));
            case Function::max: return where(call(Function::less, a, b), number(n == 0 ? 0 : 1),
                                             number(n == 0 ? 1 : 0));
            case Function::hypot: return (n == 0 ? a : b) / call(Function::hypot, a, b);
            case Function::atan2: return (n == 0 ? b : -a) / (square(a) + square(b));
            case Function::mod: return n == 0 ? one : -call(Function::floor, a / b);
            // mean + spread · noise, the noise at most 1 in magnitude.
            case Function::random: return one;
            default: return std::nullopt;
        }
    }

    Term power(Term a, Term b, std::size_t n) const {
        const auto raised = [&](Term x, Term y) {
            return Term{&builder_, builder_.power(x.id, y.id)};
        };
        if (n == 0) return b * raised(a, b - number(1));
        return call(Function::log, a) * raised(a, b);
    }

    std::optional<Term> of_three(std::size_t n) {
        const Term a = operand(0), b = operand(1), c = operand(2);
        const Term zero = number(0), one = number(1);
        switch (node_.function) {
            case Function::if_:
                if (n == 0) return zero;
                return n == 1 ? where(a, one, zero) : where(a, zero, one);
            case Function::mix: return n == 0 ? one - c : n == 1 ? c : b - a;
            case Function::clamp: {
                const Term low = call(Function::less, a, b), high = call(Function::greater, a, c);
                if (n == 0) return where(low, zero, where(high, zero, one));
                return n == 1 ? where(low, one, zero) : where(low, zero, where(high, one, zero));
            }
            case Function::smoothstep: return smoothstep(a, b, c, n);
            default: return std::nullopt;
        }
    }

    /// 3 p² − 2 p³ with p = (v − a) / (b − a) inside 0 … 1; only by v, which is its last operand.
    std::optional<Term> smoothstep(Term a, Term b, Term v, std::size_t n) const {
        if (n != 2) return std::nullopt;
        const Term p = (v - a) / (b - a);
        const Term inside = call(Function::logical_and, call(Function::greater, p, number(0)),
                                 call(Function::less, p, number(1)));
        return where(inside, number(6) * p * (number(1) - p) / (b - a), number(0));
    }

    FormulaBuilder& builder_;
    const Node node_;  ///< A copy: the builder's list grows.
};

}  // namespace

std::optional<PartId> partial_derivative(FormulaBuilder& builder, const Node& call, std::size_t n) {
    return Rules(builder, call).partial(n);
}

}  // namespace cascade
