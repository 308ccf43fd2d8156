// Powers are computed in binary64 and rounded once to binary32.
#include "picture/srgb.h"

#include <algorithm>
#include <cmath>

namespace cascade {

float steady_power(float base, double exponent) {
    return static_cast<float>(std::pow(static_cast<double>(base), exponent));
}

float light_of(float stored) {
    if (!(stored > 0)) return 0;
    return stored <= 0.04045F ? stored / 12.92F : steady_power((stored + 0.055F) / 1.055F, 2.4);
}

float stored_of(float light) {
    if (!(light > 0)) return 0;
    if (light >= 1) return 1;
    return light <= 0.0031308F ? light * 12.92F : 1.055F * steady_power(light, 1 / 2.4) - 0.055F;
}

unsigned level_of(float value, unsigned highest) {
    if (!(value > 0)) return 0;
    const double clamped = std::min(static_cast<double>(value), 1.0);
    return static_cast<unsigned>(std::floor(clamped * highest + 0.5));
}

}  // namespace cascade
