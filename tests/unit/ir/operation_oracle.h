// A second definition of the operations of the table, for tests: in double precision and with
// explicit flushing of denormals, so that no special environment is needed.
#pragma once

#include "ir/cell_kernel.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace cascade::test {

inline bool is_nan_word(std::uint32_t word) { return (word & 0x7fffffffu) > 0x7f800000u; }

/// Whether both words are the same number: equal words, or both NaN.
inline bool same_word(std::uint32_t a, std::uint32_t b) {
    return a == b || (is_nan_word(a) && is_nan_word(b));
}

/// Reads a word as a number. Denormals are zero.
inline double read_number(std::uint32_t word) {
    const bool is_tiny = (word & 0x7f800000u) == 0;
    return to_number(is_tiny ? word & 0x80000000u : word);
}

/// Rounds to 24 bits as if the range of exponents were unlimited, then flushes numbers below
/// 2^−126. If the result of one operation on two binary32 numbers is rounded to binary64 and then
/// by this function, it is the same as if it were rounded once.
inline std::uint32_t write_number(double value) {
    if (std::fabs(value) >= 0x1p-100 || std::isnan(value)) {
        return to_bits(static_cast<float>(value));
    }
    const float enlarged = static_cast<float>(value * 0x1p200);
    if (std::fabs(enlarged) < 0x1p74f) return std::signbit(value) ? 0x80000000u : 0u;
    return to_bits(static_cast<float>(enlarged * 0x1p-200));
}

/// x · y + z of three binary32 numbers, rounded to odd: the last bit is 1 if further digits are
/// lost. Rounding this again to fewer digits gives the right result.
inline double multiply_add(double x, double y, double z) {
    const double product = x * y;  // Exact.
    const double sum = product + z;
    const double added = sum - product;
    const double missing = (product - (sum - added)) + (z - added);
    if (!std::isfinite(sum) || missing == 0) return sum;
    const bool is_odd = (std::bit_cast<std::uint64_t>(sum) & 1) != 0;
    return is_odd ? sum : std::nextafter(sum, missing > 0 ? INFINITY : -INFINITY);
}

inline std::uint32_t truth(bool value) { return value ? to_bits(1.0f) : 0u; }

/// The result of an operation (other than a source) on three words.
inline std::uint32_t oracle(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const double x = read_number(a);
    const double y = read_number(b);
    switch (op) {
        case Op::add: return write_number(x + y);
        case Op::subtract: return write_number(x - y);
        case Op::multiply: return write_number(x * y);
        case Op::divide: return write_number(x / y);
        case Op::negate: return a ^ 0x80000000u;
        case Op::absolute: return a & 0x7fffffffu;
        case Op::square_root: return write_number(std::sqrt(x));
        case Op::round_to_even: return write_number(std::nearbyint(x));
        case Op::scale_by_power: return write_number(std::ldexp(x, static_cast<int>(y)));
        case Op::multiply_add: return write_number(multiply_add(x, y, read_number(c)));
        case Op::less: return truth(x < y);
        case Op::less_equal: return truth(x <= y);
        case Op::equal: return truth(x == y);
        case Op::not_equal: return truth(!(x == y));
        case Op::logical_and: return truth(!(x == 0) && !(y == 0));
        case Op::logical_or: return truth(!(x == 0) || !(y == 0));
        case Op::logical_not: return truth(x == 0);
        case Op::select: return x == 0 ? c : b;
        case Op::bits_add: return a + b;
        case Op::bits_subtract: return a - b;
        case Op::bits_multiply: return a * b;
        case Op::bits_and: return a & b;
        case Op::bits_or: return a | b;
        case Op::bits_xor: return a ^ b;
        case Op::bits_shift_left: return b > 31 ? 0 : a << b;
        case Op::bits_shift_right: return b > 31 ? 0 : a >> b;
        case Op::bits_to_number: {
            const std::int64_t word = a;
            const std::int64_t value = word >= 0x80000000 ? word - 0x100000000 : word;
            return write_number(static_cast<double>(value));
        }
        default: return 0xdeadbeef;
    }
}

}  // namespace cascade::test
