// Sets the control register of the floating-point unit.
#include "core/floating_point.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif !defined(__aarch64__)
#error "FlushDenormals knows the control registers of x86-64 and AArch64 only."
#endif

namespace cascade {
namespace {

#if defined(__x86_64__)

constexpr unsigned long long denormals_are_zero = 1u << 6;
constexpr unsigned long long flush_to_zero = 1u << 15;
constexpr unsigned long long rounding_bits = 3u << 13;  // 0 rounds to nearest even.

unsigned long long read_control() { return _mm_getcsr(); }

// The barriers keep the compiler from moving arithmetic on memory across the change.
void write_control(unsigned long long value) {
    asm volatile("" ::: "memory");
    _mm_setcsr(static_cast<unsigned>(value));
    asm volatile("" ::: "memory");
}

unsigned long long spec_control(unsigned long long control) {
    return (control & ~rounding_bits) | denormals_are_zero | flush_to_zero;
}

#else

constexpr unsigned long long flush_to_zero = 1ull << 24;  // Flushes inputs and results.
constexpr unsigned long long rounding_bits = 3ull << 22;  // 0 rounds to nearest even.

unsigned long long read_control() {
    unsigned long long value;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}

void write_control(unsigned long long value) {
    asm volatile("msr fpcr, %0" ::"r"(value) : "memory");
}

unsigned long long spec_control(unsigned long long control) {
    return (control & ~rounding_bits) | flush_to_zero;
}

#endif

}  // namespace

FlushDenormals::FlushDenormals() : saved_(read_control()) { write_control(spec_control(saved_)); }

FlushDenormals::~FlushDenormals() { write_control(saved_); }

}  // namespace cascade
