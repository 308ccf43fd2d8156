// The word that identifies a step in the random numbers of rates.
#pragma once

#include "core/precision.h"

#include <bit>
#include <cstdint>
#include <type_traits>

namespace cascade {

/// Below step 2^24, the bits of the step's number in binary32. From there on, where binary32
/// numbers are at least 2 apart, 2^31 + step, which no non-negative number has as its bits. So no
/// two steps below 2^31 have the same word.
constexpr std::uint32_t draw_of_step(std::int64_t step) {
    if (step < std::int64_t{1} << 24) return std::bit_cast<std::uint32_t>(static_cast<float>(step));
    return (std::uint32_t{1} << 31) + static_cast<std::uint32_t>(step);
}

/// A uniform that holds the word as its bits, or in binary64 as the lower half of its bits.
template <typename Number>
Number draw_uniform(std::int64_t step) {
    const std::uint32_t word = draw_of_step(step);
    if constexpr (std::is_same_v<Number, float>) {
        return std::bit_cast<float>(word);
    } else {
        // A normal number for every word.
        return std::bit_cast<double>(std::uint64_t{0x3ff00000} << 32 | word);
    }
}

}  // namespace cascade
