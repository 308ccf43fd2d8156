// The positions of samples on a pixel and on the lights.
//
// The positions are points of a low-discrepancy sequence (M. Roberts, "The Unreasonable
// Effectiveness of Quasirandom Sequences", 2018), shifted in each pixel by a hash of the pixel. So
// a pixel depends neither on its tile nor on its thread.
#pragma once

#include "core/hash.h"
#include "render/tracer.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace cascade {

/// The number of rays with which a pixel begins if it gets more than one.
inline constexpr std::uint32_t first_rays = 4;

inline float to_fraction(std::uint32_t word) {
    return static_cast<float>(word >> 8) * 0x1p-24F;  // In [0, 1).
}

/// A point of the unit square, and a third number from 0 to 1.
struct Point {
    float x = 0, y = 0, part = 0;
};

/// Point `k` of a low-discrepancy sequence in the square: multiples of 1/p and 1/p² with p³ = p +
/// 1, as fractions of 2^32, shifted by two hashed words. The third number is a multiple of the
/// golden section.
inline Point even_point(std::uint32_t k, std::uint32_t a, std::uint32_t b) {
    return {to_fraction(a + k * 3242174889u), to_fraction(b + k * 2447445414u),
            to_fraction((a ^ b) + k * 2654435769u)};
}

/// The position of ray `k` of the first rays in a pixel that gets more than one. The positions form
/// a rotated grid. Their mean is the middle of the pixel, so the mean of samples of a linear
/// function is exact.
inline Point first_point(std::uint32_t k) {
    constexpr std::array<Point, first_rays> turned = {
        {{0.375F, 0.125F}, {0.875F, 0.375F}, {0.125F, 0.625F}, {0.625F, 0.875F}}};
    return turned[k];
}

/// Maps the unit square to the unit disc, preserving ratios of areas: P. Shirley and K. Chiu, "A
/// Low Distortion Map Between Disk and Square", 1997. Sine and cosine are polynomials, because
/// library functions differ between processors.
inline DiscPoint on_disc(Point square) {
    const float a = 2 * square.x - 1, b = 2 * square.y - 1;
    const bool is_wide = std::abs(a) > std::abs(b);
    const float radius = is_wide ? a : b;
    if (radius == 0) return {0, 0, square.part};
    const float t = std::numbers::pi_v<float> / 4 * ((is_wide ? b : a) / radius);
    const float s = t * t;
    const float sine = t * (1 - s / 6 * (1 - s / 20 * (1 - s / 42)));
    const float cosine = 1 - s / 2 * (1 - s / 12 * (1 - s / 30));
    return is_wide ? DiscPoint{radius * cosine, radius * sine, square.part}
                   : DiscPoint{radius * sine, radius * cosine, square.part};
}

/// The hashed words that shift the sample positions of a pixel.
struct Shifts {
    std::array<std::uint32_t, 4> of_rays{}, of_lights{};
};

inline Shifts shifts_of(std::int64_t x, std::int64_t y) {
    const auto hash = pcg4d({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0});
    return {hash, pcg4d(hash)};
}

}  // namespace cascade
