// The floating-point environment of all arithmetic on cells.
#pragma once

namespace cascade {

/// While an object of this class lives, its thread reads denormal numbers as zero and rounds
/// denormal results to zero (keeping the sign), and rounds to nearest even. All execution of
/// kernels and all constant folding happens in this environment, which the spec prescribes.
class FlushDenormals {
public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned long long saved_;
};

/// From now on FlushDenormals only sets the rounding, in all threads, and the interpreter flushes
/// what it writes to planes, so that tests can compare results with those of WebAssembly, whose
/// arithmetic keeps denormal numbers.
void keep_denormals();
bool keeps_denormals();

}  // namespace cascade
