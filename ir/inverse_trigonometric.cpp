// asin, acos and the angle of a point, expanded into operations of the table.
//
// Arguments are folded onto a short interval around 0 by the identities of the functions (W. J. Cody
// and W. Waite, "Software Manual for the Elementary Functions", 1980), and what is taken off, a
// multiple of π/4, is added as a head and a tail. Coefficients as in ir/elementary.cpp.
#include "ir/expression.h"

#include <limits>

namespace cascade {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// (atan(t)/t − 1) / t² in t², for |t| ≤ tan(π/8); error 2^−30 of the angle.
constexpr float atan_coefficients[] = {-0x1.55554cp-2f, 0x1.99929cp-3f, -0x1.23c4f2p-3f,
                                       0x1.b2b4cep-4f, -0x1.f57118p-5f};
constexpr float tan_of_eighth = 0x1.a8279ap-2f;  // tan(π/8)

// (asin(s)/s − 1) / s² in s², for |s| ≤ ½; error 2^−31 of the angle.
constexpr float asin_coefficients[] = {0x1.555550p-3f, 0x1.333734p-4f, 0x1.6cd7c4p-5f,
                                       0x1.0367ccp-5f, 0x1.e8e968p-7f, 0x1.2e435cp-5f};

/// A multiple of π/4 as a number and what it lacks.
struct Angle {
    float head;
    float tail;
};
constexpr Angle none = {0.0f, 0.0f};
constexpr Angle eighth = {0x1.921fb6p-1f, -0x1.777a5cp-26f};         // π/4
constexpr Angle quarter = {0x1.921fb6p+0f, -0x1.777a5cp-25f};        // π/2
constexpr Angle three_eighths = {0x1.2d97c8p+1f, -0x1.99bc5cp-28f};  // 3π/4
constexpr Angle half = {0x1.921fb6p+1f, -0x1.777a5cp-24f};           // π

Expression sign_of_word(Expression x) { return x.and_word(0x80000000); }

/// The angle of a point in the upper half plane, folded twice: at the diagonal and at tan(π/8).
Expression upper_angle(Expression y, Expression x) {
    const Expression width = x.absolute();
    const Expression steep = width < y;
    const Expression longer = steep.choose(y, width);
    const Expression shorter = steep.choose(width, y);
    // So that neither the sum of the two overflows nor their difference vanishes.
    const Expression factor = (0x1p64f < longer)
                                  .choose(0x1p-64f, (longer < 0x1p-64f).choose(
                                                        0x1p64f, x.number(1.0f)));
    const Expression diagonal = equals(shorter, infinity);
    const Expression p = diagonal.choose(1.0f, shorter * factor);
    const Expression q = either(diagonal, equals(longer, 0.0f)).choose(1.0f, longer * factor);
    const Expression folded = q * tan_of_eighth < p;
    const Expression t = folded.choose(p - q, p) / folded.choose(p + q, q);
    const Expression z = t * t;
    const Expression small = t + t * (z * polynomial(z, atan_coefficients));

    const Expression backwards = x.shifted_right(31).to_number();
    const auto taken_off = [&](float Angle::*part) {
        const Expression forward =
            folded.choose(eighth.*part, steep.choose(quarter.*part, x.number(none.*part)));
        const Expression behind =
            folded.choose(three_eighths.*part, steep.choose(quarter.*part, x.number(half.*part)));
        return backwards.choose(behind, forward);
    };
    const Expression turned = steep.choose(x.word(0x80000000), x.word(0));
    const Expression sign = turned.binary(Op::bits_xor, sign_of_word(x));
    const Expression rest = small.binary(Op::bits_xor, sign);
    return taken_off(&Angle::head) + (rest + taken_off(&Angle::tail));
}

/// asin of a number from 0 to ½, or half of acos of one from ½ to 1: the sum of both parts.
struct Arc {
    Expression near;  ///< A truth: the number is at most ½.
    Expression head;
    Expression tail;
};

Arc arc_of(Expression a) {
    const Expression near = a.binary(Op::less_equal, a.number(0.5f));
    const Expression z = near.choose(a * a, (1.0f - a) * 0.5f);
    const Expression s = near.choose(a, z.unary(Op::square_root));
    const Expression curved = s * (z * polynomial(z, asin_coefficients));
    // What the square root lacks: z − h² is exact for a head h of 12 bits.
    const Expression h = near.choose(s, s.head());
    const Expression lacking = (z - h * h) / (s + h);
    const Expression has_rest = both(!near, 0.0f < s);
    return {near, h, has_rest.choose(lacking, a.number(0.0f)) + curved};
}

}  // namespace

ValueId KernelBuilder::arc_tangent(ValueId first, ValueId second) {
    const Expression y(*this, first);
    const Expression x(*this, second);
    const Expression angle = upper_angle(y.absolute(), x).binary(Op::bits_or, sign_of_word(y));
    return both(equals(y, y), equals(x, x)).choose(angle, x.number(nan)).id();
}

ValueId KernelBuilder::arc_sine(ValueId argument) {
    const Expression x(*this, argument);
    const auto [near, head, tail] = arc_of(x.absolute());
    // π/2 − 2 (head + tail)
    const Expression far = (quarter.head - head * 2.0f) - (tail * 2.0f - quarter.tail);
    return near.choose(head + tail, far).binary(Op::bits_or, sign_of_word(x)).id();
}

ValueId KernelBuilder::arc_cosine(ValueId argument) {
    const Expression x(*this, argument);
    const auto [near, head, tail] = arc_of(x.absolute());
    const Expression sign = sign_of_word(x);
    const Expression signed_head = head.binary(Op::bits_xor, sign);
    const Expression signed_tail = tail.binary(Op::bits_xor, sign);
    const Expression middle = quarter.head - (signed_head + (signed_tail - quarter.tail));
    const Expression right = (head + tail) * 2.0f;
    const Expression left = half.head - (head * 2.0f + (tail * 2.0f - half.tail));
    const Expression side = (x < 0.0f).choose(left, right);
    return near.choose(middle, side).id();
}

}  // namespace cascade
