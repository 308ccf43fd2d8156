// Formulas over values of a builder, in infix notation.
//
// Internal to ir/. An Expression is a value and its builder, and operators emit instructions. Each
// operator is one operation of the table, rounded once, in the order that C++ gives the formula.
#pragma once

#include "ir/builder.h"

#include <array>
#include <limits>
#include <span>

namespace cascade {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Constants of an algorithm that depend on the number format: a row for binary32 and one for
/// binary64. The first row has binary32 numbers, so that reading them rounds none.
template <typename Constants>
using ByPrecision = std::array<Constants, 2>;

class Expression {
public:
    Expression(KernelBuilder& builder, ValueId id) : builder_(&builder), id_(id) {}

    ValueId id() const { return id_; }
    WordFormat format() const { return builder_->format(); }
    template <typename Constants>
    const Constants& pick(const ByPrecision<Constants>& rows) const {
        return rows[static_cast<std::size_t>(builder_->precision())];
    }

    Expression number(double value) const { return {*builder_, builder_->number(value)}; }
    Expression word(std::uint64_t bits) const { return {*builder_, builder_->word(bits)}; }

    Expression unary(Op op) const { return {*builder_, builder_->apply(op, id_)}; }
    Expression binary(Op op, Expression other) const {
        return {*builder_, builder_->apply(op, id_, other.id_)};
    }

    /// The same product or quotient, excluded from contraction.
    Expression kept() const {
        builder_->keep(id_);
        return *this;
    }

    Expression absolute() const { return unary(Op::absolute); }
    /// The nearest integer, ties to even.
    Expression rounded() const { return unary(Op::round_to_even); }
    /// Times 2^n, for an integer n of −252 … 252 (−2044 … 2044). Exact, flushed, or infinite.
    Expression scaled(Expression n) const { return binary(Op::scale_by_power, n); }
    Expression clamped(double low, double high) const {
        const ValueId below = builder_->clamp_below(id_, builder_->number(low));
        return {*builder_, builder_->clamp_above(below, builder_->number(high))};
    }

    /// `then` if this value is true, else `otherwise`. Words as conditions are a trap: small
    /// integers are denormal numbers, which are false.
    Expression choose(Expression then, Expression otherwise) const {
        return {*builder_, builder_->select(id_, then.id_, otherwise.id_)};
    }
    Expression choose(double then, Expression otherwise) const {
        return choose(number(then), otherwise);
    }

    // Words as unsigned integers.
    Expression plus_word(std::uint64_t bits) const { return binary(Op::bits_add, word(bits)); }
    Expression and_word(std::uint64_t bits) const { return binary(Op::bits_and, word(bits)); }
    Expression shifted_left(int amount) const {
        return binary(Op::bits_shift_left, word(static_cast<std::uint64_t>(amount)));
    }
    Expression shifted_right(int amount) const {
        return binary(Op::bits_shift_right, word(static_cast<std::uint64_t>(amount)));
    }
    Expression to_number() const { return unary(Op::bits_to_number); }

    /// The sign bit as a word, and the number with the sign of another.
    Expression sign_word() const { return and_word(format().sign()); }
    Expression with_sign_of(Expression other) const {
        return binary(Op::bits_or, other.sign_word());
    }

    /// The number without the lower half of its significand. This leaves 12 (26) bits, so that
    /// products of two such numbers are exact.
    Expression head() const { return and_word(format().all() << (format().fraction_bits / 2 + 1)); }

    /// A word modulo 2^32, so that formulas of 32-bit words are the same in both formats.
    Expression low_word() const { return format().bits == 32 ? *this : and_word(0xffffffff); }

private:
    KernelBuilder* builder_;
    ValueId id_;
};

inline Expression operator+(Expression a, Expression b) { return a.binary(Op::add, b); }
inline Expression operator-(Expression a, Expression b) { return a.binary(Op::subtract, b); }
inline Expression operator*(Expression a, Expression b) { return a.binary(Op::multiply, b); }
inline Expression operator/(Expression a, Expression b) { return a.binary(Op::divide, b); }
inline Expression operator+(Expression a, double b) { return a + a.number(b); }
inline Expression operator-(Expression a, double b) { return a - a.number(b); }
inline Expression operator*(Expression a, double b) { return a * a.number(b); }
inline Expression operator-(double a, Expression b) { return b.number(a) - b; }
inline Expression operator/(double a, Expression b) { return b.number(a) / b; }

inline Expression operator<(Expression a, Expression b) { return a.binary(Op::less, b); }
inline Expression operator<(Expression a, double b) { return a < a.number(b); }
inline Expression operator<(double a, Expression b) { return b.number(a) < b; }
inline Expression equals(Expression a, Expression b) { return a.binary(Op::equal, b); }
inline Expression equals(Expression a, double b) { return equals(a, a.number(b)); }
inline Expression both(Expression a, Expression b) { return a.binary(Op::logical_and, b); }
inline Expression either(Expression a, Expression b) { return a.binary(Op::logical_or, b); }
inline Expression operator!(Expression a) { return a.unary(Op::logical_not); }

/// c[0] + x (c[1] + x (c[2] + …)), by Horner's rule.
Expression polynomial(Expression x, std::span<const double> coefficients);

/// A number rounded to the nearest integer, ties to even, for |x| < 2^22 (2^51).
struct Rounded {
    Expression number;  ///< As a number.
    Expression word;    ///< The integer in two's complement.
};
Rounded round_to_whole(Expression x);

/// A positive normal number as m · 2^e with m in [√½, √2).
struct Decomposed {
    Expression significand;
    Expression exponent;  ///< As a number.
};
Decomposed decompose(Expression x);

}  // namespace cascade
