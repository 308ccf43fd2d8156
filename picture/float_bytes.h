// Writes numbers as little-endian bytes.
#pragma once

#include "core/plane.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

namespace cascade {

static_assert(std::endian::native == std::endian::little);

/// Appends a number. Every NaN is written as 0x7fc00000 or 0x7ff8000000000000, so that the same run
/// gives the same file on every machine.
template <typename Number>
void append_number(std::string& bytes, Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    if constexpr (std::is_floating_point_v<Number>) {
        if (std::isnan(number)) number = std::numeric_limits<Number>::quiet_NaN();
    }
    const auto element = std::bit_cast<std::array<char, sizeof number>>(number);
    bytes.append(element.data(), element.size());
}

/// Appends the values of a field in its own precision, row by row through all slices.
void append_floats(std::string& bytes, const Field& field);

}  // namespace cascade
