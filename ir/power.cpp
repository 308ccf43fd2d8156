// x^y, expanded into operations of ir/operations.def.
//
// Constant integer exponents up to 64 are expanded into products. Other powers are computed as 2^(y
// · log2|x|). The logarithm is a head and a tail, which have 36 bits together (66 in binary64). So
// many bits are needed because y · log2|x| may be as large as 128 (1024), and its absolute error
// becomes the relative error of the result. Products of heads of 12 (26) bits are exact (G. W.
// Veltkamp and T. J. Dekker, Numerische Mathematik 18, 1971), so no fused operation is needed.
//
// The special cases are the same as in C's pow(): 1 for y = 0 or x = 1, even if the other argument
// is NaN; NaN for a finite x < 0 and a y that is not an integer; the sign of x for odd y.
#include "ir/expression.h"

#include <cmath>
#include <optional>

namespace cascade {
namespace {

constexpr double largest_multiplied = 64;

// For exponents of a magnitude above this number, the result is infinite or 0 unless |x| = 1,
// because |log2 x| is otherwise at least 2^−25 (2^−53).
constexpr ByPrecision<double> large_exponent = {0x1p40, 0x1p70};
// 2 to the power of this number is infinite, and 2 to the power of its negative is 0.
constexpr ByPrecision<double> large_logarithm = {200, 1200};

/// 2 / (3 ln 2), as one rounded number and as the sum of a head and a tail. The head has 11 bits in
/// single precision and 26 in double precision.
struct Factor {
    double rounded;
    double head;
    double tail;
};
constexpr ByPrecision<Factor> log2_factor = {
    {{0x1.ec709ep-1, 0x1.ec8p-1, -0x1.ec478cp-14},
     {0x1.ec709dc3a03fdp-1, 0x1.ec709ep-1, -0x1.e2fe0145b01f5p-28}}};

// Coefficients of (3 artanh(s)/s − 3 − s²) / s⁴ as a polynomial of s², for |s| ≤ 0.172, with an
// error of 2^−44 (2^−77) of the logarithm.
constexpr double log2_single[] = {0x1.333334p-1, 0x1.b6d9e6p-2, 0x1.55d65cp-2, 0x1.056c74p-2,
                                  0x1.d51992p-2};
constexpr double log2_double[] = {0x1.3333333333333p-1, 0x1.b6db6db6db7f4p-2, 0x1.5555555542fafp-2,
                                  0x1.1745d17e2a1c1p-2, 0x1.d89d83f9a2a6cp-3, 0x1.999a96838034p-3,
                                  0x1.69548ac328237p-3, 0x1.4390f257aea23p-3, 0x1.3ab87b29f334dp-3};
constexpr ByPrecision<std::span<const double>> log2_coefficients = {log2_single, log2_double};

// Coefficients of (2^f − 1) / f for |f| ≤ 0.51, with an error of 2^−32 (2^−59) of 2^f.
constexpr double exp2_single[] = {0x1.62e430p-1,  0x1.ebfbe0p-3,  0x1.c6b070p-5, 0x1.3b2a54p-7,
                                  0x1.5da228p-10, 0x1.4419cap-13, 0x1.e5b8e2p-17};
constexpr double exp2_double[] = {
    0x1.62e42fefa39efp-1,  0x1.ebfbdff82c58ep-3,  0x1.c6b08d704a1d1p-5,  0x1.3b2ab6fba518cp-7,
    0x1.5d87fe78754f8p-10, 0x1.430912f7619ebp-13, 0x1.ffcbfd429af0dp-17, 0x1.62c026e86747p-20,
    0x1.b5234335b9904p-24, 0x1.e4bcc117d7c51p-28, 0x1.ec533db49a12bp-32, 0x1.def3528c7368ap-36};
constexpr ByPrecision<std::span<const double>> exp2_coefficients = {exp2_single, exp2_double};

/// A number as the sum of a head of 12 (26) bits and a tail.
struct Split {
    Expression head;
    Expression tail;
};

/// s = (m − 1) / (m + 1), both as a rounded number and in two parts.
struct Quotient {
    Expression rounded;
    Split parts;
};

Quotient quotient_of(Expression m) {
    const Expression f = m - 1;  // Exact.
    const Expression d = m + 1;
    const Expression inverse = 1 / d;
    const Expression s = f * inverse;
    const Expression d_head = d.head();
    const Expression d_tail = m - (d_head - 1);  // The remaining bits of m + 1, exact.
    const Expression s_head = s.head();
    const Expression rest = (f - s_head * d_head) - s_head * d_tail;
    return {s, {s_head, rest * inverse}};
}

/// log2(x) of a positive normal number x. With the s of Quotient, ln m = 2 artanh(s) = s · ⅔ · (3 +
/// s² + …).
Split logarithm_to_base_2(Expression x) {
    const auto [m, e] = decompose(x);
    const auto [s, parts] = quotient_of(m);
    const Expression z = s * s;
    const Expression square = parts.head * parts.head;  // Exact.
    const Expression small =
        (z * z) * polynomial(z, z.pick(log2_coefficients)) + parts.tail * (parts.head + s);
    const Expression series_head = ((square + 3) + small).head();
    const Expression series_tail = small - ((series_head - 3) - square);

    const Expression product = parts.head * series_head;  // Exact.
    const Expression rest = parts.tail * series_head + series_tail * s;
    const Expression p_head = (product + rest).head();
    const Expression p_tail = rest - (p_head - product);

    const Factor& factor = x.pick(log2_factor);
    const Expression large = p_head * factor.head;  // Exact.
    const Expression little = p_head * factor.tail + p_tail * factor.rounded;
    const Expression head = ((large + little) + e).head();
    return {head, little - ((head - e) - large)};
}

/// 2^(p + q). The magnitude of q is small compared with |p| or with 1, and |p| is at most
/// `large_logarithm`.
Expression exponential_to_base_2(Expression p, Expression q) {
    const Expression n = (p + q).rounded();
    const Expression f = (p - n) + q;
    return (f * polynomial(f, f.pick(exp2_coefficients)) + 1).scaled(n);
}

/// a^y for a = |x| and any words a and y.
Expression power_of_magnitude(Expression a, Expression exponent) {
    const Expression y = exponent.clamped(-a.pick(large_exponent), a.pick(large_exponent));
    const Split logarithm = logarithm_to_base_2(a);
    const Expression y_head = y.head();
    const Expression y_tail = y - y_head;
    const Expression large = y_head * logarithm.head;  // Exact.
    const Expression little = y_tail * logarithm.head + y * logarithm.tail;
    // Zero, infinity and NaN are handled separately, because decompose() works only for normal
    // numbers, and because the head of a NaN may be the word of an infinity.
    const Expression is_ordinary = both(both(0 < a, a < infinity), equals(y, y));
    const Expression extreme = y * equals(a, 0).choose(-infinity, a);
    const Expression p = is_ordinary.choose(large, extreme);
    const double largest = a.pick(large_logarithm);
    const Expression has_tail = p.absolute() < largest;
    const Expression q = has_tail.choose(little, a.number(0));
    return exponential_to_base_2(p.clamped(-largest, largest), q);
}

struct Parity {
    Expression is_whole;  ///< Whether the number is an integer.
    Expression odd_bit;   ///< The word 1 for an odd integer, and the word 0 for any other number.
};

Parity parity_of(Expression y) {
    // For a < 2^23, the sum 2^23 + a has no fractional digits, and its last bit is the last bit of
    // the integer. From 2^23 to 2^24, the last bit of a is the last bit of the integer. All larger
    // numbers are even. In binary64 the bounds are 2^52 and 2^53.
    const double all_whole = std::ldexp(1.0, y.format().fraction_bits);
    const double all_even = 2 * all_whole;
    const Expression a = y.absolute();
    const Expression is_small = a < all_whole;
    const Expression sum = is_small.choose(a + all_whole, a);
    const Expression is_whole = either(equals(sum - all_whole, a), !is_small);
    const Expression odd_bit = (a < all_even).choose(sum.and_word(1), a.word(0));
    return {is_whole, both(is_whole, a < all_even).choose(odd_bit, a.word(0))};
}

/// `y` as an integer, if it is a constant integer of magnitude at most 64.
std::optional<int> small_whole(const KernelBuilder& builder, ValueId y) {
    if (!builder.is_constant(y)) return std::nullopt;
    const double value = builder.constant(y);
    if (!(std::fabs(value) <= largest_multiplied) || std::trunc(value) != value) {
        return std::nullopt;
    }
    return static_cast<int>(value);
}

/// x^n for n > 0. Goes through the bits of n from the lowest to the highest. If a bit is set,
/// multiplies the product by the present base. Squares the base after each bit. For example, x^3 =
/// x · (x·x) and x^7 = (x · x²) · x⁴.
Expression repeated_product(Expression x, unsigned n) {
    std::optional<Expression> product;
    Expression square = x;
    for (;; square = square * square) {
        if ((n & 1) != 0) product = product ? *product * square : square;
        n >>= 1;
        if (n == 0) return *product;
    }
}

}  // namespace

ValueId KernelBuilder::power(ValueId base, ValueId exponent) {
    const Expression x(*this, base);
    if (const std::optional<int> n = small_whole(*this, exponent)) {
        if (*n == 0) return number(1);
        const Expression product = repeated_product(x, static_cast<unsigned>(std::abs(*n)));
        return (*n > 0 ? product : 1 / product).id();
    }
    const Expression y(*this, exponent);
    const Expression magnitude = power_of_magnitude(x.absolute(), y);
    const Parity parity = parity_of(y);
    const Expression odd_sign = parity.odd_bit.shifted_left(x.format().bits - 1);
    const Expression sign = odd_sign.binary(Op::bits_and, x);
    const Expression is_negative = both(x < 0, -infinity < x);
    const Expression is_undefined = both(is_negative, !parity.is_whole);
    const Expression real = is_undefined.choose(nan, magnitude.binary(Op::bits_xor, sign));
    return either(equals(y, 0), equals(x, 1)).choose(1, real).id();
}

}  // namespace cascade
