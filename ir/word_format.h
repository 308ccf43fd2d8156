// The bit layout of words, for algorithms that work on bits.
#pragma once

#include "core/precision.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace cascade {

/// IEEE 754 binary32 or binary64. A word is stored in the lower `bits` bits of a 64-bit integer.
/// The upper bits are 0.
struct WordFormat {
    int bits;           ///< 32 or 64.
    int fraction_bits;  ///< Bits of the significand without the leading one: 23 or 52.
    int bias;           ///< Bias of the exponent: 127 or 1023.

    constexpr std::uint64_t all() const { return ~std::uint64_t{0} >> (64 - bits); }
    constexpr std::uint64_t sign() const { return std::uint64_t{1} << (bits - 1); }
    constexpr std::uint64_t fraction() const { return (std::uint64_t{1} << fraction_bits) - 1; }
    constexpr std::uint64_t exponent() const { return all() ^ sign() ^ fraction(); }
    constexpr std::uint64_t one() const {
        return static_cast<std::uint64_t>(bias) << fraction_bits;
    }
    /// The word that represents all NaNs.
    constexpr std::uint64_t nan() const { return exponent() | (fraction() ^ (fraction() >> 1)); }

    constexpr bool is_denormal(std::uint64_t word) const {
        return (word & exponent()) == 0 && (word & fraction()) != 0;
    }
    constexpr bool is_nan(std::uint64_t word) const { return (word & ~sign()) > exponent(); }
};

constexpr WordFormat format_of(Precision precision) {
    return precision == Precision::single ? WordFormat{32, 23, 127} : WordFormat{64, 52, 1023};
}

template <typename Number>
using WordOf = std::conditional_t<std::is_same_v<Number, double>, std::uint64_t, std::uint32_t>;

/// Convert a binary32 number to a word, and back.
inline std::uint32_t to_bits(float number) { return std::bit_cast<std::uint32_t>(number); }
inline float to_number(std::uint32_t bits) { return std::bit_cast<float>(bits); }

/// Rounds a number to a precision and returns it as a word.
inline std::uint64_t word_of(double number, Precision precision) {
    if (precision == Precision::binary64) return std::bit_cast<std::uint64_t>(number);
    return to_bits(static_cast<float>(number));
}
inline double number_of(std::uint64_t word, Precision precision) {
    if (precision == Precision::binary64) return std::bit_cast<double>(word);
    return to_number(static_cast<std::uint32_t>(word));
}

}  // namespace cascade
