// Arithmetic on the vectors on top of WebAssembly's stack, with or without denormal numbers.
//
// Internal to wasm/. WebAssembly computes with denormal numbers. Exact kernels flush them as x86
// does. They flush operands (by flush()), and they flush a result if it is below the least normal
// number after rounding to as many digits as normal numbers have.
#pragma once

#include "wasm/function.h"

namespace cascade::wasm {

class Arithmetic {
public:
    Arithmetic(Function& function, LoopLevel level, bool is_exact)
        : function_(function), code_(function.at(level)), level_(level), is_exact_(is_exact) {}

    bool is_exact() const { return is_exact_; }

    // These functions operate on the two vectors on top of the stack. The second operand is the
    // topmost. If the kernel is exact, no operand may be denormal.
    void add();
    void subtract();
    void multiply();
    void divide();

    /// In an exact kernel, turns denormal numbers into zeros of the same sign. Otherwise does
    /// nothing.
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
