// The effect of every operation of ir/operations.def on words. Constant folding and the interpreter
// share this definition. `Number` is float or double, the type of the words.
//
// Internal to ir/. Processors must flush denormals, so call these functions inside a
// FlushDenormals. The functions are written so that compilers vectorise loops over them.
#pragma once

#include "ir/cell_kernel.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace cascade {

/// Whether the result depends only on the operands' values in one cell or link.
constexpr bool is_function_of_operands(Op op) { return op >= Op::add; }
static_assert(static_cast<int>(Op::add) == static_cast<int>(Op::cell_slice) + 1,
              "the sources come first in the table");

template <Op op>
constexpr bool is_arithmetic = op >= Op::add&& op <= Op::divide;
template <Op op>
constexpr bool is_comparison = op >= Op::less&& op <= Op::not_equal;
template <Op op>
constexpr bool is_logic = op >= Op::logical_and&& op <= Op::logical_not;

template <typename Number>
inline constexpr auto one_bits = static_cast<WordOf<Number>>(format_of(precision_of<Number>).one());
template <typename Number>
inline constexpr auto sign_bit =
    static_cast<WordOf<Number>>(format_of(precision_of<Number>).sign());

/// Whether a word is a number other than zero. Compares the word as an integer. If the word were
/// converted to a number and compared with 0, a compiler might test the bits anyway and take a
/// denormal for true.
template <typename Number>
bool is_true(WordOf<Number> word) {
    constexpr WordFormat format = format_of(precision_of<Number>);
    constexpr auto least_normal = static_cast<WordOf<Number>>(format.fraction() + 1);
    return (word & ~sign_bit<Number>) >= least_normal;
}

template <Op op, typename Number>
Number arithmetic(Number a, Number b) {
    if constexpr (op == Op::add) return a + b;
    if constexpr (op == Op::subtract) return a - b;
    if constexpr (op == Op::multiply) return a * b;
    if constexpr (op == Op::divide) return a / b;
}

/// The nearest integer. Adding 2^23 (2^52 in binary64) to a number of smaller magnitude removes all
/// fractional digits.
template <typename Number>
Number round_to_even(Number a) {
    constexpr auto all_whole =
        static_cast<Number>(std::uint64_t{1} << format_of(precision_of<Number>).fraction_bits);
    const Number size = std::abs(a);
    return size < all_whole ? std::copysign((size + all_whole) - all_whole, a) : a;
}

/// a · 2^b. A single factor 2^b may be out of range although the product is in range, so a is
/// multiplied by two factors of about the same size. The biased exponents of the factors are the
/// two halves of b + 2 · bias. The last bits of `sum` are this integer. Shifts remove all other
/// bits.
template <typename Number>
Number scale_by_power(Number a, Number b) {
    using Word = WordOf<Number>;
    constexpr WordFormat format = format_of(precision_of<Number>);
    constexpr auto whole = static_cast<Number>(std::uint64_t{3} << (format.fraction_bits - 1));
    const auto sum = std::bit_cast<Word>(b + (whole + Number{2 * format.bias}));
    const Word half = sum >> 1;
    const auto power = [](Word exponent) {
        return std::bit_cast<Number>(static_cast<Word>(exponent << format.fraction_bits));
    };
    return (a * power(half)) * power(sum - half);
}

template <Op op, typename Number>
bool comparison(Number a, Number b) {
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

template <Op op, typename Number, typename Word = WordOf<Number>>
Word integer(Word a, Word b) {
    constexpr Word largest_shift = 8 * sizeof(Word) - 1;
    if constexpr (op == Op::bits_add) return a + b;
    if constexpr (op == Op::bits_subtract) return a - b;
    if constexpr (op == Op::bits_multiply) return a * b;
    if constexpr (op == Op::bits_and) return a & b;
    if constexpr (op == Op::bits_or) return a | b;
    if constexpr (op == Op::bits_xor) return a ^ b;
    if constexpr (op == Op::bits_shift_left) return a << (b & largest_shift);
    if constexpr (op == Op::bits_shift_right) return a >> (b & largest_shift);
    if constexpr (op == Op::bits_to_number) {
        return std::bit_cast<Word>(static_cast<Number>(static_cast<std::make_signed_t<Word>>(a)));
    }
}

/// The result of `op`. Operands beyond the arity of `op` are ignored.
template <Op op, typename Number, typename Word = WordOf<Number>>
inline Word word_operation(Word a, Word b, Word c) {
    const auto x = std::bit_cast<Number>(a);
    const auto y = std::bit_cast<Number>(b);
    if constexpr (is_arithmetic<op>) {
        return std::bit_cast<Word>(arithmetic<op>(x, y));
    } else if constexpr (op == Op::negate) {
        return a ^ sign_bit<Number>;
    } else if constexpr (op == Op::absolute) {
        return a & ~sign_bit<Number>;
    } else if constexpr (op == Op::square_root) {
        return std::bit_cast<Word>(std::sqrt(x));
    } else if constexpr (op == Op::round_to_even) {
        return std::bit_cast<Word>(round_to_even(x));
    } else if constexpr (op == Op::scale_by_power) {
        return std::bit_cast<Word>(scale_by_power(x, y));
    } else if constexpr (op == Op::multiply_add) {
        return std::bit_cast<Word>(std::fma(x, y, std::bit_cast<Number>(c)));
    } else if constexpr (is_comparison<op>) {
        return comparison<op>(x, y) ? one_bits<Number> : 0;
    } else if constexpr (is_logic<op>) {
        return logic<op>(is_true<Number>(a), is_true<Number>(b)) ? one_bits<Number> : 0;
    } else if constexpr (op == Op::select) {
        return is_true<Number>(a) ? b : c;
    } else {
        return integer<op, Number>(a, b);
    }
}

}  // namespace cascade
