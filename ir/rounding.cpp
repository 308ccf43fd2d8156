// Rounding to integers, signs and steps, expanded into operations of ir/operations.def. All results
// are exact, except that `modulus` rounds once and `smooth_step` several times.
#include "ir/expression.h"

namespace cascade {
namespace {

// Quotients from this number on are too large for the remainder to be computed. A smaller integral
// quotient is split into two halves that have few enough bits for their products to be exact.
constexpr ByPrecision<double> largest_quotient = {0x1p24, 0x1p52};

Expression whole_below(Expression x) {
    const Expression nearest = x.rounded();
    return (x < nearest).choose(nearest - 1, nearest);
}

/// The rounding error of a product: the rounded product minus the exact q · b (T. J. Dekker,
/// Numerische Mathematik 18, 1971).
Expression product_error(Expression q, Expression b, Expression product) {
    const Expression q_head = q.head();
    const Expression q_tail = q - q_head;
    const Expression b_head = b.head();
    const Expression b_tail = b - b_head;
    const Expression crossed = (q_head * b_head - product) + q_head * b_tail;
    return (crossed + q_tail * b_head) + q_tail * b_tail;
}

Expression differ_in_sign(Expression a, Expression b) {
    const Expression negative = a < 0;
    return both(negative.binary(Op::not_equal, b < 0), !equals(a, 0));
}

}  // namespace

ValueId KernelBuilder::round_to_even(ValueId argument) {
    return apply(Op::round_to_even, argument);
}

ValueId KernelBuilder::round_down(ValueId argument) {
    return whole_below(Expression(*this, argument)).id();
}

ValueId KernelBuilder::round_up(ValueId argument) {
    const Expression x(*this, argument);
    return whole_below(x.unary(Op::negate)).unary(Op::negate).id();
}

ValueId KernelBuilder::sign_of(ValueId argument) {
    const Expression x(*this, argument);
    // Multiplying by 1 flushes a denormal number to zero.
    const Expression zero_or_nan = x * 1;
    return (x < 0).choose(-1, (0 < x).choose(1, zero_or_nan)).id();
}

ValueId KernelBuilder::modulus(ValueId x, ValueId y) {
    const Expression a(*this, x);
    const Expression b(*this, y);
    const Expression quotient = (a / b).kept();
    const Expression q = whole_below(quotient);
    const Expression product = (q * b).kept();
    const Expression rest = (a - product) - product_error(q, b, product);
    // If the quotient was rounded up to an integer, `rest` is small and has the wrong sign.
    const Expression moved = differ_in_sign(rest, b).choose(rest + b, rest);
    const Expression is_meaningful = quotient.absolute() < a.pick(largest_quotient);
    const Expression finite = is_meaningful.choose(moved, a.number(nan));
    const Expression of_infinite = differ_in_sign(a, b).choose(b, a);
    const Expression is_infinite = both(equals(b.absolute(), infinity), a.absolute() < infinity);
    return is_infinite.choose(of_infinite, finite).id();
}

ValueId KernelBuilder::smooth_step(ValueId low, ValueId high, ValueId argument) {
    const Expression from(*this, low);
    const Expression position =
        (Expression(*this, argument) - from) / (Expression(*this, high) - from);
    const Expression t = position.kept().clamped(0, 1);
    return ((t * t) * (3 - t * 2)).id();
}

}  // namespace cascade
