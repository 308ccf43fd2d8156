// Cube root and hypotenuse, expanded into operations of ir/operations.def.
//
// The cube root of m · 2^(3k) is ∛m · 2^k. A polynomial approximates ∛m, whose value t is cut to 12
// bits (26 in binary64), so that the residual m − t³ is exact. One step of Halley's method (W.
// Kahan, "Computing a real cube root", 1991) then improves t.
#include "ir/expression.h"

namespace cascade {
namespace {

// Coefficients of ∛m for m in [√½, √2), with an error of 2^−16 (2^−22).
constexpr double cube_root_single[] = {0x1.ce7218p-2, 0x1.cf6544p-1, -0x1.127106p-1, 0x1.bcd31ap-3,
                                       -0x1.36184ap-5};
constexpr double cube_root_double[] = {0x1.97ecf6b6e5344p-2,  0x1.326f1282751bep+0,
                                       -0x1.2fd80377786a2p+0, 0x1.f11cba034e209p-1,
                                       -0x1.078c14f4b1ce7p-1, 0x1.3ee5a0ceebdbap-3,
                                       -0x1.4dd55b1ff21fdp-6};
constexpr ByPrecision<std::span<const double>> cube_root_coefficients = {cube_root_single,
                                                                         cube_root_double};
constexpr ByPrecision<double> cube_root_of_2 = {0x1.428a30p+0, 0x1.428a2f98d728bp+0};
constexpr ByPrecision<double> cube_root_of_half = {0x1.965feap-1, 0x1.965fea53d6e3dp-1};
constexpr ByPrecision<double> third_of_one = {0x1.555556p-2, 0x1.5555555555555p-2};

/// Squares of numbers above `large` may overflow, and squares of numbers below `small` may vanish.
/// After a multiplication by `reduce` or `enlarge`, which are powers of two, the squares of these
/// numbers neither overflow nor vanish.
struct Reach {
    double large, reduce;
    double small, enlarge;
};
constexpr ByPrecision<Reach> square_reach = {
    {{0x1p60, 0x1p-70, 0x1p-50, 0x1p75}, {0x1p500, 0x1p-600, 0x1p-450, 0x1p600}}};

/// Selects one of three numbers by the sign of n.
Expression by_sign(Expression n, double below, double at, double above) {
    return (n < 0).choose(below, (0 < n).choose(above, n.number(at)));
}

/// One step of Halley's method from t towards ∛y. The number t has 12 (26) bits.
Expression halley_step(Expression t, Expression y) {
    const Expression square = t * t;  // Exact.
    const Expression square_head = square.head();
    const Expression square_tail = square - square_head;
    const Expression rest = (y - square_head * t) - square_tail * t;
    return t + t * (rest / (square * t * 2 + y));
}

}  // namespace

ValueId KernelBuilder::cube_root(ValueId argument) {
    const Expression x(*this, argument);
    const Expression a = x.absolute();
    const auto [m, e] = decompose(a);
    const Expression third = (e * x.pick(third_of_one)).rounded();
    const Expression left = e - third * 3;  // −1, 0 or 1.
    const Expression y = m * by_sign(left, 0.5, 1, 2);
    const Expression guess = polynomial(m, x.pick(cube_root_coefficients)) *
                             by_sign(left, x.pick(cube_root_of_half), 1, x.pick(cube_root_of_2));
    const Expression magnitude = halley_step(guess.head(), y).scaled(third);
    const Expression root = magnitude.with_sign_of(x);
    // The roots of zero, infinity and NaN are the numbers themselves. x + x returns these numbers
    // and flushes denormal numbers.
    return both(0 < a, a < infinity).choose(root, x + x).id();
}

/// √(x² + y²). Both numbers are scaled so that their squares neither overflow nor vanish.
ValueId KernelBuilder::hypotenuse(ValueId first, ValueId second) {
    const Expression x = Expression(*this, first).absolute();
    const Expression y = Expression(*this, second).absolute();
    const Expression larger = (x < y).choose(y, x);
    const Reach& reach = x.pick(square_reach);
    const Expression is_large = reach.large < larger;
    const Expression is_small = larger < reach.small;
    const Expression factor =
        is_large.choose(reach.reduce, is_small.choose(reach.enlarge, x.number(1)));
    const Expression back =
        is_large.choose(1 / reach.reduce, is_small.choose(1 / reach.enlarge, x.number(1)));
    const Expression u = x * factor;
    const Expression v = y * factor;
    const Expression finite = (u * u + v * v).unary(Op::square_root) * back;
    return either(equals(x, infinity), equals(y, infinity)).choose(infinity, finite).id();
}

}  // namespace cascade
