// The floating-point environment that all arithmetic of cells runs in.
#pragma once

namespace cascade {

/// While it lives, this thread reads denormal numbers as zero and rounds denormal results to zero
/// (the sign is kept), rounding to nearest even: the one environment of the spec's numerics. Every
/// executor, the folding of constants included, works inside one.
class FlushDenormals {
public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned long long saved_;
};

}  // namespace cascade
