// Products and quotients may be denormal and inexact at once. A result just below the least normal
// number would then be rounded up to this number, although x86 flushes the result. Hence exact
// kernels repeat the operation with operands enlarged by powers of two. The enlarged result is
// normal and rounded to all digits, so it shows whether to flush.
//
// No operand is denormal, so enlarged operands overflow only if the true result is zero or far from
// being denormal. The enlarged result is then infinite or NaN, and nothing is flushed.
#include "wasm/arithmetic.h"

#include <cmath>

namespace cascade::wasm {
namespace {

/// Each of two factors is enlarged by the power of two with this exponent.
int enlarging_power(Precision precision) { return precision == Precision::single ? 32 : 256; }

}  // namespace

// A denormal sum is exact, so it is enough to flush the result to zero.
void Arithmetic::add() {
    code_.write(Lanes::add);
    flush();
}

void Arithmetic::subtract() {
    code_.write(Lanes::subtract);
    flush();
}

void Arithmetic::multiply() {
    if (!is_exact_) return code_.write(Lanes::multiply);
    const int power = enlarging_power(function_.precision());
    with_larger_operands(Lanes::multiply, power, power);
}

void Arithmetic::divide() {
    if (!is_exact_) return code_.write(Lanes::divide);
    with_larger_operands(Lanes::divide, 2 * enlarging_power(function_.precision()), 0);
}

void Arithmetic::flush() {
    if (!is_exact_) return;
    const Local number = function_.keep(level_);
    code_.get(number);
    code_.get(number);
    function_.give_back(number, level_);
    flush_below(0);
}

/// Repeats the operation with both operands multiplied by powers of two. The product of these
/// powers is the factor of the result.
void Arithmetic::with_larger_operands(Lanes operation, int first_power, int second_power) {
    const Local second = function_.keep(level_), first = function_.keep(level_);
    code_.get(first);
    code_.get(second);
    code_.write(operation);
    const auto larger = [&](Local operand, int power) {
        code_.get(operand);
        if (power == 0) return;
        code_.get(function_.number(std::ldexp(1.0, power)));
        code_.write(Lanes::multiply);
    };
    larger(first, first_power);
    larger(second, second_power);
    code_.write(operation);
    function_.give_back(first, level_);
    function_.give_back(second, level_);
    flush_below(first_power + second_power);
}

/// On top of the stack are a number and, above it, the same number enlarged by a power of two.
/// Leaves the number, or a zero of the same sign if the enlarged number shows that it is below the
/// least normal number.
void Arithmetic::flush_below(int power) {
    const WordFormat format = function_.format();
    code_.write(Lanes::absolute);
    code_.get(function_.number(std::ldexp(1.0, 1 - format.bias + power)));
    code_.write(Lanes::less);
    code_.get(function_.constant(format.all() ^ format.sign()));
    code_.write(Whole::bits_and);
    code_.write(Whole::bits_and_not);
}

}  // namespace cascade::wasm
