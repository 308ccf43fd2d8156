// What every operation of the table does with words: the one definition behind the folding of
// constants and the loops of the interpreter.
//
// Internal to ir/. Denormals are flushed by the processor, so all of this is right only inside a
// FlushDenormals. The functions are written such that loops over them become vector code.
#pragma once

#include "ir/cell_kernel.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace cascade {

/// True for the operations that depend on their operands alone.
constexpr bool is_function_of_operands(Op op) { return op >= Op::add; }
static_assert(static_cast<int>(Op::add) == static_cast<int>(Op::cell_slice) + 1,
              "the sources come first in the table");

template <Op op>
constexpr bool is_arithmetic = op >= Op::add && op <= Op::divide;
template <Op op>
constexpr bool is_comparison = op >= Op::less && op <= Op::not_equal;
template <Op op>
constexpr bool is_logic = op >= Op::logical_and && op <= Op::logical_not;

inline constexpr std::uint32_t one_bits = 0x3f800000;
inline constexpr std::uint32_t sign_bit = 0x80000000;

/// A number other than zero. Asked of the word, because compilers that see a number made from a word
/// and compared with 0 may look at its bits, and take a denormal for true.
inline bool is_true(std::uint32_t word) { return (word & ~sign_bit) >= 0x00800000; }

template <Op op>
float arithmetic(float a, float b) {
    if constexpr (op == Op::add) return a + b;
    if constexpr (op == Op::subtract) return a - b;
    if constexpr (op == Op::multiply) return a * b;
    if constexpr (op == Op::divide) return a / b;
}

template <Op op>
bool comparison(float a, float b) {
    if constexpr (op == Op::less) return a < b;
    if constexpr (op == Op::less_equal) return a <= b;
    if constexpr (op == Op::equal) return a == b;
    if constexpr (op == Op::not_equal) return a != b;
}

template <Op op>
bool logic(bool a, bool b) {
    if constexpr (op == Op::logical_and) return a & b;
    if constexpr (op == Op::logical_or) return a | b;
    if constexpr (op == Op::logical_not) return !a;
}

template <Op op>
std::uint32_t integer(std::uint32_t a, std::uint32_t b) {
    if constexpr (op == Op::bits_add) return a + b;
    if constexpr (op == Op::bits_subtract) return a - b;
    if constexpr (op == Op::bits_multiply) return a * b;
    if constexpr (op == Op::bits_and) return a & b;
    if constexpr (op == Op::bits_or) return a | b;
    if constexpr (op == Op::bits_xor) return a ^ b;
    if constexpr (op == Op::bits_shift_left) return a << (b & 31);
    if constexpr (op == Op::bits_shift_right) return a >> (b & 31);
    if constexpr (op == Op::bits_to_number) {
        return std::bit_cast<std::uint32_t>(static_cast<float>(static_cast<std::int32_t>(a)));
    }
}

/// The word that `op` makes of its operands; those beyond its arity are not looked at.
template <Op op>
inline std::uint32_t word_operation(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const float x = std::bit_cast<float>(a);
    const float y = std::bit_cast<float>(b);
    if constexpr (is_arithmetic<op>) {
        return std::bit_cast<std::uint32_t>(arithmetic<op>(x, y));
    } else if constexpr (op == Op::negate) {
        return a ^ sign_bit;
    } else if constexpr (op == Op::absolute) {
        return a & ~sign_bit;
    } else if constexpr (op == Op::square_root) {
        return std::bit_cast<std::uint32_t>(std::sqrt(x));
    } else if constexpr (is_comparison<op>) {
        return comparison<op>(x, y) ? one_bits : 0;
    } else if constexpr (is_logic<op>) {
        return logic<op>(is_true(a), is_true(b)) ? one_bits : 0;
    } else if constexpr (op == Op::select) {
        return is_true(a) ? b : c;
    } else {
        return integer<op>(a, b);
    }
}

}  // namespace cascade
