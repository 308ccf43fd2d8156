// Colours as pictures store them (sRGB) and the amounts of light that they mean: IEC 61966-2-1.
#pragma once

#include "core/palette.h"

namespace cascade {

/// Of a channel: 0 is 0 and 1 is 1. What is below 0 or NaN becomes 0. The same bits on every
/// processor.
float light_of(float stored);

/// The other way, clamped to 0 … 1, both of which stay; NaN becomes 0.
float stored_of(float light);

inline Colour light_of(const Colour& stored) {
    return {light_of(stored[0]), light_of(stored[1]), light_of(stored[2])};
}
inline Colour stored_of(const Colour& light) {
    return {stored_of(light[0]), stored_of(light[1]), stored_of(light[2])};
}

/// A number as one of the levels 0 … `highest` of a file, rounded to the nearest one and clamped;
/// NaN becomes 0.
unsigned level_of(float value, unsigned highest);

/// base ^ exponent, computed in binary64: the library's functions of binary32 differ in their last
/// bit from processor to processor, those of binary64, rounded, do not.
float steady_power(float base, double exponent);

}  // namespace cascade
