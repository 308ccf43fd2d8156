#include "picture/light.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

// The library's functions differ in their last bit from processor to processor. Those of binary64,
// rounded to binary32, do not.
float power(float base, double exponent) {
    return static_cast<float>(std::pow(static_cast<double>(base), exponent));
}

}  // namespace

float to_light(float stored) {
    if (!(stored > 0)) return 0;
    return stored <= 0.04045F ? stored / 12.92F : power((stored + 0.055F) / 1.055F, 2.4);
}

float to_stored(float light) {
    if (!(light > 0)) return 0;
    if (light >= 1) return 1;
    return light <= 0.0031308F ? light * 12.92F : 1.055F * power(light, 1 / 2.4) - 0.055F;
}

unsigned level_of(float value, unsigned highest) {
    if (!(value > 0)) return 0;
    const double clamped = std::min(static_cast<double>(value), 1.0);
    return static_cast<unsigned>(std::floor(clamped * highest + 0.5));
}

}  // namespace cascade
