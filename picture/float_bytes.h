// Numbers as bytes of files, little-endian.
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

/// Appends a number; every NaN as one, 0x7fc00000 or 0x7ff8000000000000, so that equal runs give
/// equal files.
template <typename Number>
void append_number(std::string& bytes, Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    if constexpr (std::is_floating_point_v<Number>) {
        if (std::isnan(number)) number = std::numeric_limits<Number>::quiet_NaN();
    }
    const auto element = std::bit_cast<std::array<char, sizeof number>>(number);
    bytes.append(element.data(), element.size());
}

/// Appends the cells of a field, row by row through all slices, as float32 or float64, as its
/// precision is.
void append_floats(std::string& bytes, const Field& field);

}  // namespace cascade
