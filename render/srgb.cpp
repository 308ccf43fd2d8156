#include "render/srgb.h"

#include <algorithm>
#include <cmath>

namespace cascade {

float steady_power(float base, double exponent) {
    return static_cast<float>(std::pow(static_cast<double>(base), exponent));
}

float light_of(float stored) {
    return stored <= 0.04045F ? stored / 12.92F : steady_power((stored + 0.055F) / 1.055F, 2.4);
}

float stored_of(float light) {
    const float clamped = std::clamp(light, 0.0F, 1.0F);
    return clamped <= 0.0031308F ? clamped * 12.92F
                                 : 1.055F * steady_power(clamped, 1 / 2.4) - 0.055F;
}

}  // namespace cascade
