// sin, cos and tan, expanded into operations of the table.
//
// The angle is brought to |r| ≤ π/4 by taking off n quarter turns; π/2 is split into four pieces of
// 11 bits, whose products with n are exact, and a rest. What rounding loses is carried along as a
// tail. So r is right to its last bit for every angle up to 8192, even beside multiples of π/2.
//
// Angles from 8192 to 2^24 are first brought below 3217 by taking off multiples of 4096 quarter
// turns in the same way; r then has an absolute error of at most 2^−33. Beyond 2^24, where
// neighbouring numbers are 2 and more apart, an angle means nothing and the result is NaN, as it is
// for infinities. −0 has the sine −0.
#include "ir/expression.h"

#include <array>
#include <limits>

namespace cascade {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float largest_angle = 0x1p24f;
constexpr float largest_direct_angle = 8192.0f;

constexpr float quarter_turns_per_radian = 0x1.45f306p-1f;  // 2/π
constexpr std::array<float, 5> quarter_turn = {0x1.92p+0f, 0x1.fb8p-12f, -0x1.5ep-23f, 0x1.0b8p-34f,
                                               -0x1.cf72cep-45f};
constexpr float many = 4096.0f;  // Quarter turns that are taken off large angles together.

// (sin(r)/r − 1) / r² in r², for |r| ≤ 0.79; error 2^−32 of the sine.
constexpr float sin_coefficients[] = {-0x1.555556p-3f, 0x1.111174p-7f, -0x1.a05904p-13f,
                                      0x1.7c0226p-19f};

// (cos(r) − 1 + r²/2) / r⁴ in r², for |r| ≤ 0.79; error 2^−32 of the cosine.
constexpr float cos_coefficients[] = {0x1.55554ap-5f, -0x1.6c0c20p-10f, 0x1.99e42cp-16f};

/// A number as the sum of two, the second being about 2^−24 of the first.
struct Sum {
    Expression head;
    Expression tail;
};

/// a − b where the rounding error is itself a number: T. J. Dekker, "A floating-point technique for
/// extending the available precision", Numerische Mathematik 18, 1971.
Sum exact_difference(Expression a, Expression b) {
    const Expression difference = a - b;
    return {difference, (a - difference) - b};
}

/// The angle without n · unit quarter turns.
Sum take_off(Expression angle, Expression n, float unit) {
    const Expression rough =
        (angle - n * (quarter_turn[0] * unit)) - n * (quarter_turn[1] * unit);  // Exact.
    const Sum third = exact_difference(rough, n * (quarter_turn[2] * unit));
    const Sum fourth = exact_difference(third.head, n * (quarter_turn[3] * unit));
    const Expression tail = (third.tail + fourth.tail) - n * (quarter_turn[4] * unit);
    return {fourth.head, tail};
}

struct SineAndCosine {
    Expression sine;
    Expression cosine;
};

/// Of an angle of at most about π/4.
SineAndCosine of_small_angle(Sum r) {
    const Expression z = r.head * r.head;
    const Expression half = z * 0.5f;
    const Expression rough_cosine = 1.0f - half;
    const Expression lost = (1.0f - rough_cosine) - half;
    const Expression curved_cosine = (z * z) * polynomial(z, cos_coefficients);
    const Expression cosine = rough_cosine + (lost + (curved_cosine - r.head * r.tail));
    const Expression curved_sine = (r.head * z) * polynomial(z, sin_coefficients);
    const Expression sine = r.head + (curved_sine + r.tail * rough_cosine);
    return {sine, cosine};
}

/// Sine and cosine of what is left of an angle without a number of quarter turns.
struct Reduced {
    SineAndCosine rest;
    Expression quarter_turns;  ///< As a word.
};

/// Of an angle that is not negative.
Reduced reduce(Expression angle) {
    const Expression turns = round_to_whole(angle * (quarter_turns_per_radian / many)).number;
    const Expression whole = (largest_direct_angle < angle).choose(turns, angle.number(0.0f));
    const Sum large = take_off(angle, whole, many);
    const Rounded n = round_to_whole(large.head * quarter_turns_per_radian);
    const Sum rest = take_off(large.head, n.number, 1.0f);
    const Expression tail = rest.tail + large.tail;
    const Expression head = rest.head + tail;
    return {of_small_angle({head, (rest.head - head) + tail}), n.word};
}

Expression nan_if_too_large(Expression angle, Expression value) {
    const Expression is_angle = angle.binary(Op::less_equal, angle.number(largest_angle));
    return is_angle.choose(value, angle.number(nan));
}

/// Sine (turned = 0) or cosine (turned = 1) of an angle that is not negative, as the sine of the
/// angle and `turned` quarter turns.
Expression sine_of(Expression angle, std::uint32_t turned) {
    const auto [rest, quarter_turns] = reduce(angle);
    const Expression quadrant = quarter_turns.plus_word(turned);
    const Expression is_odd = quadrant.and_word(1).to_number();
    const Expression sign = quadrant.and_word(2).shifted_left(30);
    const Expression value = is_odd.choose(rest.cosine, rest.sine).binary(Op::bits_xor, sign);
    return nan_if_too_large(angle, value);
}

}  // namespace

ValueId KernelBuilder::sine(ValueId argument) {
    const Expression x(*this, argument);
    const Expression value = sine_of(x.absolute(), 0);
    return value.binary(Op::bits_xor, x.and_word(0x80000000)).id();
}

ValueId KernelBuilder::cosine(ValueId argument) {
    return sine_of(Expression(*this, argument).absolute(), 1).id();
}

/// sin / cos, and −cos / sin after an odd number of quarter turns.
ValueId KernelBuilder::tangent(ValueId argument) {
    const Expression x(*this, argument);
    const Expression angle = x.absolute();
    const auto [rest, quarter_turns] = reduce(angle);
    const Expression is_odd = quarter_turns.and_word(1).to_number();
    const Expression quotient =
        is_odd.choose(rest.cosine, rest.sine) / is_odd.choose(rest.sine, rest.cosine);
    const Expression sign = quarter_turns.and_word(1).shifted_left(31);
    const Expression value = nan_if_too_large(angle, quotient.binary(Op::bits_xor, sign));
    return value.binary(Op::bits_xor, x.and_word(0x80000000)).id();
}

}  // namespace cascade
