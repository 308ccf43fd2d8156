// The floating-point environment of all arithmetic on cells.
#pragma once

namespace cascade {

/// While an object of this class exists, its thread reads denormal numbers as zero, rounds denormal
/// results to zero (with their sign), and rounds to nearest even. The spec prescribes this
/// environment for all execution of kernels and all constant folding.
class FlushDenormals {
public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned long long saved_;
};

/// For tests that compare results with WebAssembly, whose arithmetic has denormal numbers. After
/// this call, FlushDenormals sets only the rounding, in all threads, and the interpreter flushes
/// the values that it writes to planes.
void keep_denormals();
bool keeps_denormals();

}  // namespace cascade
