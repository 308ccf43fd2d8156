// Positions along a Morton curve (G. M. Morton, "A computer oriented geodetic data base", IBM,
// 1966).
#pragma once

#include <cstdint>

namespace cascade {

/// Spreads the lower 21 bits to every third bit.
constexpr std::uint64_t every_third(std::uint64_t bits) {
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x001f00000000ffff;
    bits = (bits | bits << 16) & 0x001f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
}

/// The position of a box along the curve, by the lower 21 bits of its coordinates.
constexpr std::uint64_t morton_place(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return every_third(x) | every_third(y) << 1 | every_third(z) << 2;
}

}  // namespace cascade
