// Powers are computed in binary64 and rounded once to binary32.
#include "picture/srgb.h"

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

}  // namespace cascade
