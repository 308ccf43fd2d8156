// exp, log, sinh, cosh and tanh, expanded into operations of the table.
//
// The methods are the classical ones (W. J. Cody and W. Waite, "Software Manual for the Elementary
// Functions", 1980; J.-M. Muller, "Elementary Functions", 3rd ed., 2016): reduce the argument with
// a constant split into an exact head and a tail, evaluate a polynomial, put the result together.
// The coefficients are ours: weighted minimax fits, rounded to binary32 one after the other, each
// time fitting the rest again. No operation fuses, so every executor computes the same bits.
//
// Largest errors, in units in the last place of the exact value:
//     exp 1.0    log 0.9               all binary32 arguments
//     sinh 2.0   cosh 2.0   tanh 1.5   all
//     sin 0.8    cos 0.8    tan 2.2    magnitudes up to 8192; see ir/trigonometric.cpp
//     asin 1.1   acos 1.1   atan2 2.1  all; see ir/inverse_trigonometric.cpp
//     cbrt 0.6   hypot 1.2             all; see ir/roots.cpp
//     x^y 1.2                          see ir/power.cpp
// Denormal arguments count as zeros and denormal results are flushed.
#include "ir/expression.h"

#include <limits>

namespace cascade {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

constexpr float log2_of_e = 0x1.715476p+0f;
// ln 2 as a head of 14 bits, whose product with a whole number of 10 bits is exact, and the rest.
constexpr float ln2_head = 0x1.62e8p-1f;
constexpr float ln2_tail = -0x1.e8082ep-16f;

// (e^r − 1 − r) / r² for |r| ≤ 0.354; error 2^−33 of e^r.
constexpr float exp_coefficients[] = {0x1.000000p-1f, 0x1.555554p-3f,  0x1.5554e0p-5f,
                                      0x1.11130ap-7f, 0x1.6d5826p-10f, 0x1.9e15e8p-13f};

// (2 artanh(s)/s − 2) / s² in s², for |s| ≤ 0.172; error 2^−35 of the logarithm.
constexpr float log_coefficients[] = {0x1.555554p-1f, 0x1.999c24p-2f, 0x1.23d4dcp-2f,
                                      0x1.f103dep-3f};

// (sinh(a)/a − 1) / a² in a², for a ≤ 1; error 2^−31 of sinh.
constexpr float sinh_coefficients[] = {0x1.555556p-3f, 0x1.1110d8p-7f, 0x1.a02800p-13f,
                                       0x1.749762p-19f};

// (tanh(a)/a − 1) / a² in a², for a ≤ 0.55; error 2^−29 of tanh.
constexpr float tanh_coefficients[] = {-0x1.55554cp-2f, 0x1.110d6ap-3f, -0x1.b931fep-5f,
                                       0x1.5982a4p-6f, -0x1.9c9668p-8f};

/// A number as m · 2^n with m about 1.
struct Scaled {
    Expression factor;
    Expression exponent;  ///< As a word.
};

/// e^x. Beyond ±100 the result is infinite or 0 as it is at ±100.
Scaled scaled_exponential(Expression argument) {
    const Expression x = argument.clamped(-100.0f, 100.0f);
    const Rounded n = round_to_whole(x * log2_of_e);
    const Expression r = (x - n.number * ln2_head) - n.number * ln2_tail;
    const Expression curved = (r * r) * polynomial(r, exp_coefficients);
    return {(r + curved) + 1.0f, n.word};
}

/// e^x / 2, which is finite wherever sinh and cosh are.
Expression half_exponential(Expression x) {
    const Scaled power = scaled_exponential(x);
    return scale(power.factor, power.exponent.plus_word(-1u));
}

}  // namespace

ValueId KernelBuilder::exponential(ValueId argument) {
    const Scaled power = scaled_exponential(Expression(*this, argument));
    return scale(power.factor, power.exponent).id();
}

ValueId KernelBuilder::hyperbolic_sine(ValueId argument) {
    const Expression x(*this, argument);
    const Expression a = x.absolute();
    const Expression z = a * a;
    const Expression near = a + a * (z * polynomial(z, sinh_coefficients));
    const Expression growth = half_exponential(a);
    const Expression far = growth - 0.25f / growth;
    const Expression magnitude = (a < 1.0f).choose(near, far);
    return magnitude.binary(Op::bits_or, x.and_word(0x80000000)).id();
}

ValueId KernelBuilder::hyperbolic_cosine(ValueId argument) {
    const Expression growth = half_exponential(Expression(*this, argument).absolute());
    return (growth + 0.25f / growth).id();
}

ValueId KernelBuilder::logarithm(ValueId argument) {
    const Expression x(*this, argument);
    const auto [m, e] = decompose(x);
    // With s = f / (2 + f): ln(1 + f) = 2 artanh(s), and 2 s = f − h + s h for h = f²/2. In this
    // form the large part, f, is exact.
    const Expression f = m - 1.0f;
    const Expression s = f / (f + 2.0f);
    const Expression z = s * s;
    const Expression h = (f * f) * 0.5f;
    const Expression curved = s * (h + z * polynomial(z, log_coefficients));
    const Expression small = h - (curved + e * ln2_tail);
    const Expression finite = e * ln2_head - (small - f);
    const Expression positive = (x < infinity).choose(finite, x);  // Infinity and NaN stay.
    const Expression real = equals(x, 0.0f).choose(-infinity, positive);
    return (x < 0.0f).choose(nan, real).id();
}

ValueId KernelBuilder::hyperbolic_tangent(ValueId argument) {
    const Expression x(*this, argument);
    const Expression a = x.absolute();
    // Near 0 the difference below would cancel.
    const Expression z = a * a;
    const Expression near = a + a * (z * polynomial(z, tanh_coefficients));
    const Expression growth(*this, exponential((a + a).id()));
    const Expression far = 1.0f - 2.0f / (growth + 1.0f);
    const Expression magnitude = (a < 0.55f).choose(near, far);
    return magnitude.binary(Op::bits_or, x.and_word(0x80000000)).id();
}

}  // namespace cascade
