// Arithmetic on vectors on top of the stack, with or without denormal numbers.
//
// Internal to wasm/. WebAssembly has denormal numbers. Exact kernels flush them as x86 does: the
// operands (by flush()), and results that are below the least normal number when rounded to as many
// digits as normal numbers have.
#pragma once

#include "wasm/function.h"

namespace cascade::wasm {

class Arithmetic {
public:
    Arithmetic(Function& function, LoopLevel level, bool is_exact)
        : function_(function), code_(function.at(level)), level_(level), is_exact_(is_exact) {}

    bool is_exact() const { return is_exact_; }

    // The second operand is on top of the stack. If the kernel is exact, no operand is denormal.
    void add();
    void subtract();
    void multiply();
    void divide();

    /// Turns denormal numbers into zeros of the same sign, if the kernel is exact.
    void flush();

private:
    void with_larger_operands(Lanes operation, int first_power, int second_power);
    void flush_below(int power);

    Function& function_;
    Code& code_;
    LoopLevel level_;
    bool is_exact_;
};

}  // namespace cascade::wasm
