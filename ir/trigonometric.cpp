// sin, cos and tan, expanded into operations of ir/operations.def.
//
// The angle is reduced to |r| ≤ π/4 by subtracting n quarter turns. π/2 is split into four parts of
// 11 bits (26 in binary64), whose products with n are exact, and a remainder. The rounding errors
// are collected in a tail of r. So r is correct to its last bit for every angle up to 8192 (2^27),
// even next to multiples of π/2.
//
// Angles from 8192 to 2^24 (2^27 to 2^53) are first reduced to less than 3217 (2^26), by
// subtracting multiples of 4096 (2^26) quarter turns. Then r has an absolute error of at most 2^−33
// (2^−77). Beyond 2^24 (2^53) adjacent numbers are at least 2 apart, so an angle has no meaning.
// The result is then NaN, and it is NaN for infinities, too. The sine of −0 is −0.
#include "ir/expression.h"

#include <array>

namespace cascade {
namespace {

/// The constants by which angles are reduced.
struct AngleReduction {
    double largest_angle;
    double largest_direct_angle;
    /// Multiples of this number of quarter turns are first subtracted from large angles.
    double many;
    std::array<double, 5> quarter_turn;  ///< The four parts of π/2 and the remainder.
};
constexpr ByPrecision<AngleReduction> angle_reductions = {
    {{0x1p24, 0x1p13, 0x1p12, {0x1.92p+0, 0x1.fb8p-12, -0x1.5ep-23, 0x1.0b8p-34, -0x1.cf72cep-45}},
     {0x1p53,
      0x1p27,
      0x1p26,
      {0x1.921fb58p+0, -0x1.dde974p-27, 0x1.1a6263p-54, 0x1.8a2e038p-81,
       -0x1.f1976b7ed8fbcp-110}}}};
constexpr ByPrecision<double> quarter_turns_per_radian = {0x1.45f306p-1,  // 2/π
                                                          0x1.45f306dc9c883p-1};

// Coefficients of (sin(r)/r − 1) / r² as a polynomial of r², for |r| ≤ 0.79, with a relative
// error of the sine of 2^−32 in single and 2^−63 in double precision.
constexpr double sin_single[] = {-0x1.555556p-3, 0x1.111174p-7, -0x1.a05904p-13, 0x1.7c0226p-19};
constexpr double sin_double[] = {-0x1.5555555555555p-3,  0x1.1111111111069p-7,
                                 -0x1.a01a019ffe538p-13, 0x1.71de3a33a9ca5p-19,
                                 -0x1.ae642c5a8b7f2p-26, 0x1.6109c4df77e2cp-33,
                                 -0x1.a001da9aec246p-41};
constexpr ByPrecision<std::span<const double>> sin_coefficients = {sin_single, sin_double};

// Coefficients of (cos(r) − 1 + r²/2) / r⁴ as a polynomial of r², for |r| ≤ 0.79, with an error of
// 2^−32 (2^−69) of the cosine.
constexpr double cos_single[] = {0x1.55554ap-5, -0x1.6c0c20p-10, 0x1.99e42cp-16};
constexpr double cos_double[] = {0x1.5555555555555p-5,  -0x1.6c16c16c16b31p-10,
                                 0x1.a01a019ffcf6fp-16, -0x1.27e4fb5a7a892p-22,
                                 0x1.1eed6ff967326p-29, -0x1.9374ed5847254p-37,
                                 0x1.9dfa0de9af30ap-45};
constexpr ByPrecision<std::span<const double>> cos_coefficients = {cos_single, cos_double};

/// A number as head + tail. The tail is about 2^−24 (2^−53) times the head.
struct Sum {
    Expression head;
    Expression tail;
};

/// The rounded difference a − b, and its rounding error. The error is exact if it is a number of
/// the format (T. J. Dekker, "A floating-point technique for extending the available precision",
/// Numerische Mathematik 18, 1971).
Sum exact_difference(Expression a, Expression b) {
    const Expression difference = a - b;
    return {difference, (a - difference) - b};
}

/// The angle minus n · unit quarter turns.
Sum take_off(Expression angle, Expression n, double unit) {
    const std::array<double, 5>& quarter_turn = angle.pick(angle_reductions).quarter_turn;
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

/// Sine and cosine of an angle of at most about π/4.
SineAndCosine of_small_angle(Sum r) {
    const Expression z = r.head * r.head;
    const Expression half = z * 0.5;
    const Expression rough_cosine = 1 - half;
    const Expression lost = (1 - rough_cosine) - half;
    const Expression curved_cosine = (z * z) * polynomial(z, z.pick(cos_coefficients));
    const Expression cosine = rough_cosine + (lost + (curved_cosine - r.head * r.tail));
    const Expression curved_sine = (r.head * z) * polynomial(z, z.pick(sin_coefficients));
    const Expression sine = r.head + (curved_sine + r.tail * rough_cosine);
    return {sine, cosine};
}

/// The sine and cosine of a reduced angle, and the number of quarter turns that the reduction
/// subtracted.
struct Reduced {
    SineAndCosine rest;
    Expression quarter_turns;  ///< An integer in two's complement.
};

/// Reduces an angle of at least 0.
Reduced reduce(Expression angle) {
    const AngleReduction& by = angle.pick(angle_reductions);
    const double per_radian = angle.pick(quarter_turns_per_radian);
    const Expression turns = round_to_whole(angle * (per_radian / by.many)).number;
    const Expression whole = (by.largest_direct_angle < angle).choose(turns, angle.number(0));
    const Sum large = take_off(angle, whole, by.many);
    const Rounded n = round_to_whole(large.head * per_radian);
    const Sum rest = take_off(large.head, n.number, 1);
    const Expression tail = rest.tail + large.tail;
    const Expression head = rest.head + tail;
    return {of_small_angle({head, (rest.head - head) + tail}), n.word};
}

Expression nan_if_too_large(Expression angle, Expression value) {
    const Expression is_angle =
        angle.binary(Op::less_equal, angle.number(angle.pick(angle_reductions).largest_angle));
    return is_angle.choose(value, angle.number(nan));
}

/// The sine of (angle + `turned` quarter turns), for an angle ≥ 0. So `turned` = 0 gives the sine
/// of the angle, and `turned` = 1 its cosine.
Expression sine_of(Expression angle, std::uint64_t turned) {
    const auto [rest, quarter_turns] = reduce(angle);
    const Expression quadrant = quarter_turns.plus_word(turned);
    const Expression is_odd = quadrant.and_word(1).to_number();
    const Expression sign = quadrant.and_word(2).shifted_left(angle.format().bits - 2);
    const Expression value = is_odd.choose(rest.cosine, rest.sine).binary(Op::bits_xor, sign);
    return nan_if_too_large(angle, value);
}

}  // namespace

ValueId KernelBuilder::sine(ValueId argument) {
    const Expression x(*this, argument);
    const Expression value = sine_of(x.absolute(), 0);
    return value.binary(Op::bits_xor, x.sign_word()).id();
}

ValueId KernelBuilder::cosine(ValueId argument) {
    return sine_of(Expression(*this, argument).absolute(), 1).id();
}

/// The tangent is sin / cos of the reduced angle, or −cos / sin after an odd number of quarter
/// turns.
ValueId KernelBuilder::tangent(ValueId argument) {
    const Expression x(*this, argument);
    const Expression angle = x.absolute();
    const auto [rest, quarter_turns] = reduce(angle);
    const Expression is_odd = quarter_turns.and_word(1).to_number();
    const Expression quotient =
        is_odd.choose(rest.cosine, rest.sine) / is_odd.choose(rest.sine, rest.cosine);
    const Expression sign = quarter_turns.and_word(1).shifted_left(x.format().bits - 1);
    const Expression value = nan_if_too_large(angle, quotient.binary(Op::bits_xor, sign));
    return value.binary(Op::bits_xor, x.sign_word()).id();
}

}  // namespace cascade
