// exp, log, sinh, cosh and tanh, expanded into operations of ir/operations.def.
//
// The methods are classical (W. J. Cody and W. Waite, "Software Manual for the Elementary
// Functions", 1980; J.-M. Muller, "Elementary Functions", 3rd ed., 2016). They reduce the argument
// by a constant that is split into an exact head and a tail, evaluate a polynomial, and reconstruct
// the result. The coefficients are weighted minimax fits made for Cascade. They were rounded to the
// format one by one, and after each rounding the other coefficients were fitted again. No operation
// is fused, so every executor computes the same bits. The algorithms are the same in binary32 and
// binary64. Tables give the constants that differ between the two. Comments give the value for
// binary32, followed by the value for binary64 in brackets.
//
// Largest errors, in units in the last place of the exact value:
//     exp 1.0    log 0.9               all binary32 arguments
//     sinh 2.0   cosh 2.0   tanh 1.5   all
//     sin 0.8    cos 0.8    tan 2.2    magnitudes up to 8192; see ir/trigonometric.cpp
//     asin 1.1   acos 1.1   atan2 2.1  all; see ir/inverse_trigonometric.cpp
//     cbrt 0.6   hypot 1.2             all; see ir/roots.cpp
//     x^y 1.2                          see ir/power.cpp
//
// Denormal arguments count as zeros, and denormal results are flushed to zero.
#include "ir/expression.h"

namespace cascade {
namespace {

constexpr ByPrecision<double> log2_of_e = {0x1.715476p+0, 0x1.71547652b82fep+0};

/// ln 2 as the sum of a head and a tail. The head has 14 (42) bits, so its product with the
/// exponent of a number is exact.
struct SplitNumber {
    double head;
    double tail;
};
constexpr ByPrecision<SplitNumber> ln2 = {
    {{0x1.62e8p-1, -0x1.e8082ep-16}, {0x1.62e42fefa38p-1, 0x1.ef35793c7673p-45}}};

/// If x is above this number, exp(x) is infinite. If x is below the negative of this number, exp(x)
/// is 0.
constexpr ByPrecision<double> exp_reach = {100, 750};

// Coefficients of (e^r − 1 − r) / r² for |r| ≤ 0.347, with an error of 2^−33 (2^−63) of e^r.
constexpr double exp_single[] = {0x1.000000p-1, 0x1.555554p-3,  0x1.5554e0p-5,
                                 0x1.11130ap-7, 0x1.6d5826p-10, 0x1.9e15e8p-13};
constexpr double exp_double[] = {
    0x1.0000000000000p-1,  0x1.555555555555bp-3,  0x1.5555555555538p-5,  0x1.111111110ed8bp-7,
    0x1.6c16c16c23bf1p-10, 0x1.a01a01b32d42dp-13, 0x1.a01a01627b44bp-16, 0x1.71ddf0acc9b1fp-19,
    0x1.27e56b7283b64p-22, 0x1.af6b445dfd100p-26, 0x1.1e99cba9a8d4ap-29};
constexpr ByPrecision<std::span<const double>> exp_coefficients = {exp_single, exp_double};

// Coefficients of (2 artanh(s)/s − 2) / s² as a polynomial of s², for |s| ≤ 0.172, with an error of
// 2^−35 (2^−67) of the logarithm.
constexpr double log_single[] = {0x1.555554p-1, 0x1.999c24p-2, 0x1.23d4dcp-2, 0x1.f103dep-3};
constexpr double log_double[] = {0x1.5555555555555p-1, 0x1.9999999999c71p-2, 0x1.2492492450090p-2,
                                 0x1.c71c722476616p-3, 0x1.745cf2f046de4p-3, 0x1.3b1be82892b24p-3,
                                 0x1.0fff3b75b16f1p-3, 0x1.03c1bff31ad59p-3, 0x1.626c8a3d50bc8p-5};
constexpr ByPrecision<std::span<const double>> log_coefficients = {log_single, log_double};

// Coefficients of (sinh(a)/a − 1) / a² as a polynomial of a², for a ≤ 1, with an error of 2^−31
// (2^−62) of sinh.
constexpr double sinh_single[] = {0x1.555556p-3, 0x1.1110d8p-7, 0x1.a02800p-13, 0x1.749762p-19};
constexpr double sinh_double[] = {0x1.5555555555555p-3,  0x1.111111111119ap-7,
                                  0x1.a01a01a0076ffp-13, 0x1.71de3a6884e07p-19,
                                  0x1.ae64418041398p-26, 0x1.613110a20e7fbp-33,
                                  0x1.a68cd14262705p-41, 0x1.cd84bf4ddefa3p-48};
constexpr ByPrecision<std::span<const double>> sinh_coefficients = {sinh_single, sinh_double};

// Coefficients of (tanh(a)/a − 1) / a² as a polynomial of a², for a ≤ 0.55, with an error of 2^−29
// (2^−60) of tanh.
constexpr double tanh_single[] = {-0x1.55554cp-2, 0x1.110d6ap-3, -0x1.b931fep-5, 0x1.5982a4p-6,
                                  -0x1.9c9668p-8};
constexpr double tanh_double[] = {
    -0x1.555555555554fp-2,  0x1.1111111110793p-3,  -0x1.ba1ba1b97cfa6p-5,  0x1.664f4859546f6p-6,
    -0x1.226e2f1130738p-7,  0x1.d6d29b1b514cap-9,  -0x1.7d8fcdd262886p-10, 0x1.348380be66a46p-11,
    -0x1.e96e074b97d57p-13, 0x1.5d6f89a5f0370p-14, -0x1.47058bf3dd2bfp-16};
constexpr ByPrecision<std::span<const double>> tanh_coefficients = {tanh_single, tanh_double};
constexpr ByPrecision<double> tanh_border = {0x1.19999ap-1, 0.55};

/// A number factor · 2^n, with a factor of about 1.
struct Scaled {
    Expression factor;
    Expression exponent;
};

/// e^x. The argument is clamped to ± exp_reach, where the result is already infinite or 0.
Scaled scaled_exponential(Expression argument) {
    const Expression x = argument.clamped(-argument.pick(exp_reach), argument.pick(exp_reach));
    const Expression n = (x * x.pick(log2_of_e)).rounded();
    const Expression r = (x - n * x.pick(ln2).head) - n * x.pick(ln2).tail;
    const Expression curved = (r * r) * polynomial(r, x.pick(exp_coefficients));
    return {(r + curved) + 1, n};
}

/// e^x / 2, which is finite for every x for which sinh(x) and cosh(x) are finite.
Expression half_exponential(Expression x) {
    const Scaled power = scaled_exponential(x);
    return power.factor.scaled(power.exponent - 1);
}

}  // namespace

ValueId KernelBuilder::exponential(ValueId argument) {
    const Scaled power = scaled_exponential(Expression(*this, argument));
    return power.factor.scaled(power.exponent).id();
}

ValueId KernelBuilder::hyperbolic_sine(ValueId argument) {
    const Expression x(*this, argument);
    const Expression a = x.absolute();
    const Expression z = a * a;
    const Expression near = a + a * (z * polynomial(z, x.pick(sinh_coefficients)));
    const Expression growth = half_exponential(a);
    const Expression far = growth - 0.25 / growth;
    const Expression magnitude = (a < 1).choose(near, far);
    return magnitude.with_sign_of(x).id();
}

ValueId KernelBuilder::hyperbolic_cosine(ValueId argument) {
    const Expression growth = half_exponential(Expression(*this, argument).absolute());
    return (growth + 0.25 / growth).id();
}

ValueId KernelBuilder::logarithm(ValueId argument) {
    const Expression x(*this, argument);
    const auto [m, e] = decompose(x);
    // With s = f / (2 + f) and h = f²/2: ln(1 + f) = 2 artanh(s), and 2 s = f − h + s h. In the
    // second form the largest term, f, is exact.
    const Expression f = m - 1;
    const Expression s = f / (f + 2);
    const Expression z = s * s;
    const Expression h = (f * f) * 0.5;
    const Expression curved = s * (h + z * polynomial(z, x.pick(log_coefficients)));
    const Expression small = h - (curved + e * x.pick(ln2).tail);
    const Expression finite = e * x.pick(ln2).head - (small - f);
    // An argument that is infinite or NaN is its own result.
    const Expression positive = (x < infinity).choose(finite, x);
    const Expression real = equals(x, 0).choose(-infinity, positive);
    return (x < 0).choose(nan, real).id();
}

ValueId KernelBuilder::hyperbolic_tangent(ValueId argument) {
    const Expression x(*this, argument);
    const Expression a = x.absolute();
    // Near 0, the difference of exponentials below would lose digits by cancellation.
    const Expression z = a * a;
    const Expression near = a + a * (z * polynomial(z, x.pick(tanh_coefficients)));
    const Expression growth(*this, exponential((a + a).id()));
    const Expression far = 1 - 2 / (growth + 1);
    const Expression magnitude = (a < x.pick(tanh_border)).choose(near, far);
    return magnitude.with_sign_of(x).id();
}

}  // namespace cascade
