// The word that identifies a time step when rates draw random numbers.
#pragma once

#include "core/precision.h"

#include <bit>
#include <cstdint>
#include <type_traits>

namespace cascade {

/// The word of a step. For steps below 2^24 it is the step's number in binary32. For later steps it
/// is 2^31 + step, because binary32 numbers from 2^24 on are at least 2 apart. No non-negative
/// number has the bits of such a word, so any two steps below 2^31 have different words.
constexpr std::uint32_t draw_of_step(std::int64_t step) {
    if (step < std::int64_t{1} << 24) return std::bit_cast<std::uint32_t>(static_cast<float>(step));
    return (std::uint32_t{1} << 31) + static_cast<std::uint32_t>(step);
}

/// The uniform that stores the step's word: in binary32 as its 32 bits, in binary64 in the lower
/// half of its bits.
template <typename Number>
Number draw_uniform(std::int64_t step) {
    const std::uint32_t word = draw_of_step(step);
    if constexpr (std::is_same_v<Number, float>) {
        return std::bit_cast<float>(word);
    } else {
        // This upper half makes the result a normal number for any word.
        return std::bit_cast<double>(std::uint64_t{0x3ff00000} << 32 | word);
    }
}

}  // namespace cascade
