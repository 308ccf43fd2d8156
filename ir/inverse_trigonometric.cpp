// asin, acos and the angle of a point, expanded into operations of ir/operations.def.
//
// Identities of the functions reduce the argument to a short interval around 0 (W. J. Cody and W.
// Waite, "Software Manual for the Elementary Functions", 1980). The identities change the angle by
// a multiple of π/4, which is added at the end as a head and a tail. ir/elementary.cpp explains the
// coefficients.
#include "ir/expression.h"

namespace cascade {
namespace {

// Coefficients of (atan(t)/t − 1) / t² as a polynomial of t², for |t| ≤ tan(π/8), with an error of
// 2^−30 (2^−63) of the angle.
constexpr double atan_single[] = {-0x1.55554cp-2, 0x1.99929cp-3, -0x1.23c4f2p-3, 0x1.b2b4cep-4,
                                  -0x1.f57118p-5};
constexpr double atan_double[] = {
    -0x1.5555555555554p-2, 0x1.9999999999592p-3, -0x1.24924924702e5p-3, 0x1.c71c71b4e9fe7p-4,
    -0x1.745d14698bbb9p-4, 0x1.3b13678703244p-4, -0x1.110c1637b75ecp-4, 0x1.e16b4d2113a6cp-5,
    -0x1.ab54999750efdp-5, 0x1.704f1b853c3ebp-5, -0x1.10d8ab095b952p-5, 0x1.ec95e53aab699p-7};
constexpr ByPrecision<std::span<const double>> atan_coefficients = {atan_single, atan_double};
constexpr ByPrecision<double> tan_of_eighth = {0x1.a8279ap-2, 0x1.a827999fcef32p-2};  // tan(π/8)

// Coefficients of (asin(s)/s − 1) / s² as a polynomial of s², for |s| ≤ ½, with an error of 2^−31
// (2^−63) of the angle.
constexpr double asin_single[] = {0x1.555550p-3, 0x1.333734p-4, 0x1.6cd7c4p-5,
                                  0x1.0367ccp-5, 0x1.e8e968p-7, 0x1.2e435cp-5};
constexpr double asin_double[] = {
    0x1.5555555555553p-3,  0x1.33333333339e8p-4, 0x1.6db6db6d4c57cp-5,  0x1.f1c71ca6dd014p-6,
    0x1.6e8b9b19ee83ap-6,  0x1.1c4f826d9a856p-6, 0x1.c98131facbd0ep-7,  0x1.7ba13d27acb3p-7,
    0x1.36d6aa7c4b231p-7,  0x1.47ad5a5225e72p-7, 0x1.764876ce9350dp-11, 0x1.95a8b0d68748ap-6,
    -0x1.ab1153c532dfap-6, 0x1.133ac6097cf2fp-5};
constexpr ByPrecision<std::span<const double>> asin_coefficients = {asin_single, asin_double};

/// If a coordinate is above this number or below its reciprocal, both coordinates are scaled before
/// they are added.
constexpr ByPrecision<double> far_away = {0x1p64, 0x1p512};

/// A multiple of π/4: the rounded number, and its rounding error.
struct Angle {
    double head;
    double tail;
};
/// π/4, π/2, 3π/4 and π.
struct Angles {
    Angle eighth, quarter, three_eighths, half;
};
constexpr ByPrecision<Angles> eighths = {{{{0x1.921fb6p-1, -0x1.777a5cp-26},
                                           {0x1.921fb6p+0, -0x1.777a5cp-25},
                                           {0x1.2d97c8p+1, -0x1.99bc5cp-28},
                                           {0x1.921fb6p+1, -0x1.777a5cp-24}},
                                          {{0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
                                           {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
                                           {0x1.2d97c7f3321d2p+1, 0x1.a79394c9e8a0ap-54},
                                           {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53}}}};

/// The angle of a point in the upper half plane. Reflections in the diagonal and in the line of
/// slope tan(π/8) reduce the angle.
Expression upper_angle(Expression y, Expression x) {
    const Expression width = x.absolute();
    const Expression steep = width < y;
    const Expression longer = steep.choose(y, width);
    const Expression shorter = steep.choose(width, y);
    // The scaling prevents overflow of the sum of both coordinates and underflow of their
    // difference.
    const double reach = x.pick(far_away);
    const Expression factor =
        (reach < longer).choose(1 / reach, (longer < 1 / reach).choose(reach, x.number(1)));
    const Expression diagonal = equals(shorter, infinity);
    const Expression p = diagonal.choose(1, shorter * factor);
    const Expression q = either(diagonal, equals(longer, 0)).choose(1, longer * factor);
    const Expression folded = q * x.pick(tan_of_eighth) < p;
    const Expression t = folded.choose(p - q, p) / folded.choose(p + q, q);
    const Expression z = t * t;
    const Expression small = t + t * (z * polynomial(z, x.pick(atan_coefficients)));

    const Expression backwards = x.shifted_right(x.format().bits - 1).to_number();
    const Angles& angles = x.pick(eighths);
    const auto taken_off = [&](double Angle::*part) {
        const double at_quarter = angles.quarter.*part;
        const Expression if_forwards =
            folded.choose(angles.eighth.*part, steep.choose(at_quarter, x.number(0)));
        const Expression if_backwards =
            folded.choose(angles.three_eighths.*part,
                          steep.choose(at_quarter, x.number(angles.half.*part)));
        return backwards.choose(if_backwards, if_forwards);
    };
    const Expression turned = steep.choose(x.word(x.format().sign()), x.word(0));
    const Expression sign = turned.binary(Op::bits_xor, x.sign_word());
    const Expression rest = small.binary(Op::bits_xor, sign);
    return taken_off(&Angle::head) + (rest + taken_off(&Angle::tail));
}

/// asin(a) for a from 0 to ½, or acos(a) / 2 for a from ½ to 1. The value is head + tail.
struct Arc {
    Expression near;  ///< Whether a is at most ½, so that the arc is asin(a).
    Expression head;
    Expression tail;
};

Arc arc_of(Expression a) {
    const Expression near = a.binary(Op::less_equal, a.number(0.5));
    const Expression z = near.choose(a * a, (1 - a) * 0.5);
    const Expression s = near.choose(a, z.unary(Op::square_root));
    const Expression curved = s * (z * polynomial(z, a.pick(asin_coefficients)));
    // The rounding error of the square root is (z − h²) / (s + h). For a head h of 12 (26) bits,
    // the difference z − h² is exact.
    const Expression h = near.choose(s, s.head());
    const Expression lacking = (z - h * h) / (s + h);
    const Expression has_rest = both(!near, 0 < s);
    return {near, h, has_rest.choose(lacking, a.number(0)) + curved};
}

}  // namespace

ValueId KernelBuilder::arc_tangent(ValueId first, ValueId second) {
    const Expression y(*this, first);
    const Expression x(*this, second);
    const Expression angle = upper_angle(y.absolute(), x).with_sign_of(y);
    return both(equals(y, y), equals(x, x)).choose(angle, x.number(nan)).id();
}

ValueId KernelBuilder::arc_sine(ValueId argument) {
    const Expression x(*this, argument);
    const auto [near, head, tail] = arc_of(x.absolute());
    // asin(a) = π/2 − 2 (head + tail).
    const Angle& quarter = x.pick(eighths).quarter;
    const Expression far = (quarter.head - head * 2) - (tail * 2 - quarter.tail);
    return near.choose(head + tail, far).with_sign_of(x).id();
}

ValueId KernelBuilder::arc_cosine(ValueId argument) {
    const Expression x(*this, argument);
    const auto [near, head, tail] = arc_of(x.absolute());
    const auto& [eighth, quarter, three_eighths, half] = x.pick(eighths);
    const Expression sign = x.sign_word();
    const Expression signed_head = head.binary(Op::bits_xor, sign);
    const Expression signed_tail = tail.binary(Op::bits_xor, sign);
    const Expression middle = quarter.head - (signed_head + (signed_tail - quarter.tail));
    const Expression right = (head + tail) * 2;
    const Expression left = half.head - (head * 2 + (tail * 2 - half.tail));
    const Expression side = (x < 0).choose(left, right);
    return near.choose(middle, side).id();
}

}  // namespace cascade
