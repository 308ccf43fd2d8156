// Sets the control register of the floating-point unit.
#include "core/floating_point.h"

#include <atomic>

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif !defined(__aarch64__)
#error "FlushDenormals knows the control registers of x86-64 and AArch64 only."
#endif

namespace cascade {
namespace {

#if defined(__x86_64__)

// Flushes denormal operands and results.
constexpr unsigned long long flushing = 1u << 6 | 1u << 15;
constexpr unsigned long long rounding_bits = 3u << 13;  // 0 rounds to nearest even.

unsigned long long read_control() { return _mm_getcsr(); }

// The barriers stop the compiler from moving arithmetic on memory across the change.
void write_control(unsigned long long value) {
    asm volatile("" ::: "memory");
    _mm_setcsr(static_cast<unsigned>(value));
    asm volatile("" ::: "memory");
}

#else

constexpr unsigned long long flushing = 1ull << 24;       // Flushes denormal operands and results.
constexpr unsigned long long rounding_bits = 3ull << 22;  // 0 rounds to nearest even.

unsigned long long read_control() {
    unsigned long long value;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}

void write_control(unsigned long long value) {
    asm volatile("msr fpcr, %0" ::"r"(value) : "memory");
}

#endif

std::atomic<bool> are_kept = false;

unsigned long long spec_control(unsigned long long control) {
    const unsigned long long flushed = are_kept ? 0 : flushing;
    return (control & ~(rounding_bits | flushing)) | flushed;
}

}  // namespace

FlushDenormals::FlushDenormals() : saved_(read_control()) { write_control(spec_control(saved_)); }

FlushDenormals::~FlushDenormals() { write_control(saved_); }

void keep_denormals() { are_kept = true; }
bool keeps_denormals() { return are_kept; }

}  // namespace cascade
