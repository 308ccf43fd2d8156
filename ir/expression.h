// Writes formulas over values of a KernelBuilder in infix notation.
//
// Internal to ir/. An Expression is a value and the builder that made it. Each operator of
// Expression emits one operation of ir/operations.def, which rounds once. The operations are
// emitted in the order in which C++ evaluates the formula.
#pragma once

#include "ir/builder.h"

#include <array>
#include <limits>
#include <span>

namespace cascade {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Constants of an algorithm that depend on the number format: a row for binary32 and a row for
/// binary64. The numbers of the first row are exact in binary32.
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

    /// Excludes this product or quotient from contraction, and returns it.
    Expression kept() const {
        builder_->keep(id_);
        return *this;
    }

    Expression absolute() const { return unary(Op::absolute); }
    /// The nearest integer, ties to even.
    Expression rounded() const { return unary(Op::round_to_even); }
    /// This number times 2^n, for an integer n of −252 … 252 (in binary64 −2044 … 2044). The result
    /// is exact, or flushed to 0, or infinite.
    Expression scaled(Expression n) const { return binary(Op::scale_by_power, n); }
    Expression clamped(double low, double high) const {
        const ValueId below = builder_->clamp_below(id_, builder_->number(low));
        return {*builder_, builder_->clamp_above(below, builder_->number(high))};
    }

    /// The value `then` where this value is true, and elsewhere `otherwise`. Integer words must not
    /// be used as conditions: small integers are denormal numbers, which count as false.
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

    /// The sign bit as a word.
    Expression sign_word() const { return and_word(format().sign()); }
    Expression with_sign_of(Expression other) const {
        return binary(Op::bits_or, other.sign_word());
    }

    /// The number without the lower half of its significand. The remaining 12 bits (26 in binary64)
    /// are so few that the product of two such numbers is exact.
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

/// A number rounded to the nearest integer, ties to even. Valid for |x| < 2^22 (2^51 in binary64).
struct Rounded {
    Expression number;  ///< The integer, as a number.
    Expression word;    ///< The same integer, in two's complement.
};
Rounded round_to_whole(Expression x);

/// A positive normal number, written as significand · 2^exponent with the significand in [√½, √2).
struct Decomposed {
    Expression significand;
    Expression exponent;  ///< An integer, as a number.
};
Decomposed decompose(Expression x);

}  // namespace cascade
