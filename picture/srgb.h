// Converts between sRGB values and linear light: IEC 61966-2-1.
#pragma once

#include "core/palette.h"

#include <algorithm>
#include <span>

namespace cascade {

/// Converts an sRGB channel to linear light. 0 and 1 stay unchanged. Negative numbers and NaN
/// become 0. The result has the same bits on every processor.
float light_of(float stored);

/// The inverse of light_of(), clamped to 0 … 1. NaN becomes 0.
float stored_of(float light);

inline Colour light_of(const Colour& stored) {
    const float red = light_of(stored[0]);
    if (stored[1] == stored[0] && stored[2] == stored[0]) return {red, red, red};
    return {red, light_of(stored[1]), light_of(stored[2])};
}
inline Colour stored_of(const Colour& light) {
    const float red = stored_of(light[0]);
    if (light[1] == light[0] && light[2] == light[0]) return {red, red, red};
    return {red, stored_of(light[1]), stored_of(light[2])};
}

/// The following functions apply light_of() or stored_of() to each colour, but in a fraction of the
/// time of separate calls.
void convert_to_light(std::span<Colour> colours);
void convert_to_stored(std::span<Colour> colours);

/// Clamps a value to 0 … 1 and maps this range to the integers 0 … `highest`, with rounding. NaN
/// becomes 0.
inline unsigned level_of(float value, unsigned highest) {
    // In this form, compilers can vectorise the computation.
    const double most = highest, amount = static_cast<double>(value) * most;
    const double above = amount > 0 ? amount : 0.0;
    return static_cast<unsigned>(static_cast<int>((above < most ? above : most) + 0.5));
}

/// base ^ exponent, computed in binary64 and rounded. The standard library's binary32 functions
/// differ in the last bit between processors. The rounded results of the library's binary64
/// functions do not differ.
float steady_power(float base, double exponent);

}  // namespace cascade
