// Cube root and hypotenuse, expanded into operations of the table.
//
// The cube root of a number m · 2^(3k) is that of m, begun by a polynomial and brought to full
// length by one step of Halley's rule (W. Kahan, "Computing a real cube root", 1991), in which the
// rest m − t³ is exact, t being a number of 12 bits.
#include "ir/expression.h"

#include <limits>

namespace cascade {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// ∛m for m in [√½, √2); error 2^−16.
constexpr float cube_root_coefficients[] = {0x1.ce7218p-2f, 0x1.cf6544p-1f, -0x1.127106p-1f,
                                            0x1.bcd31ap-3f, -0x1.36184ap-5f};
constexpr float cube_root_of_2 = 0x1.428a30p+0f;
constexpr float cube_root_of_half = 0x1.965feap-1f;

/// One of three numbers by the sign of n.
Expression by_sign(Expression n, float below, float at, float above) {
    return (n < 0.0f).choose(below, (0.0f < n).choose(above, n.number(at)));
}

/// t improved towards ∛y, where t has 12 bits.
Expression halley_step(Expression t, Expression y) {
    const Expression square = t * t;  // Exact.
    const Expression square_head = square.head();
    const Expression square_tail = square - square_head;
    const Expression rest = (y - square_head * t) - square_tail * t;
    return t + t * (rest / (square * t * 2.0f + y));
}

}  // namespace

ValueId KernelBuilder::cube_root(ValueId argument) {
    const Expression x(*this, argument);
    const Expression a = x.absolute();
    const auto [m, e] = decompose(a);
    const Rounded third = round_to_whole(e * (1.0f / 3.0f));
    const Expression left = e - third.number * 3.0f;  // −1, 0 or 1.
    const Expression y = m * by_sign(left, 0.5f, 1.0f, 2.0f);
    const Expression guess = polynomial(m, cube_root_coefficients) *
                             by_sign(left, cube_root_of_half, 1.0f, cube_root_of_2);
    const Expression magnitude = scale(halley_step(guess.head(), y), third.word);
    const Expression root = magnitude.binary(Op::bits_or, x.and_word(0x80000000));
    // Zero, infinity and NaN are their own; the sum flushes a denormal number.
    return both(0.0f < a, a < infinity).choose(root, x + x).id();
}

/// √(x² + y²), both brought to where squares neither overflow nor vanish.
ValueId KernelBuilder::hypotenuse(ValueId first, ValueId second) {
    const Expression x = Expression(*this, first).absolute();
    const Expression y = Expression(*this, second).absolute();
    const Expression larger = (x < y).choose(y, x);
    const Expression is_large = 0x1p60f < larger;
    const Expression is_small = larger < 0x1p-50f;
    const Expression factor =
        is_large.choose(0x1p-70f, is_small.choose(0x1p75f, x.number(1.0f)));
    const Expression back = is_large.choose(0x1p70f, is_small.choose(0x1p-75f, x.number(1.0f)));
    const Expression u = x * factor;
    const Expression v = y * factor;
    const Expression finite = (u * u + v * v).unary(Op::square_root) * back;
    return either(equals(x, infinity), equals(y, infinity)).choose(infinity, finite).id();
}

}  // namespace cascade
