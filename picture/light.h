// Numbers of a picture and the amounts of light that they stand for (IEC 61966-2-1, "sRGB").
#pragma once

#include "core/palette.h"

namespace cascade {

/// Of one channel; 0 is 0 and 1 is 1. What is below 0 or NaN becomes 0, what is above 1 stays
/// above. The same on every processor.
float to_light(float stored);

/// The number that stands for an amount of light, clamped to 0 … 1, both of which stay; NaN becomes 0.
float to_stored(float light);

/// A number as one of the levels 0 … `highest` of a file, rounded to the nearest one and clamped; NaN
/// becomes 0.
unsigned level_of(float value, unsigned highest);

inline Colour to_light(const Colour& stored) {
    return {to_light(stored[0]), to_light(stored[1]), to_light(stored[2])};
}
inline Colour to_stored(const Colour& light) {
    return {to_stored(light[0]), to_stored(light[1]), to_stored(light[2])};
}

}  // namespace cascade
