// Adds rays in their order, so that pictures are the same on every machine.
#include "render/pixel_light.h"

#include "picture/srgb.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr float least_opacity = 0.5F / 65535;  ///< Lower opacities would be stored as 0 in 16 bits.

void add(const Colour& light, float part, Colour& sum) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += light[c] * part;
}

}  // namespace

Colour tone_of(const Colour& light) {
    Colour tone{};
    for (std::size_t c = 0; c < 3; ++c) tone[c] = std::sqrt(std::max(light[c], 0.0F));
    return tone;
}

Colour light_of(const Seen& seen, float sun, float sky) {
    Colour sum = seen.always;
    add(seen.of_sun, sun, sum);
    add(seen.of_sky, sky, sum);
    return sum;
}

PixelLight light_of_ray(const Seen& seen, float sun, float sky) {
    PixelLight result{light_of(seen, sun, sky)};
    if (seen.kind == Seen::Kind::surface) return result;
    result.open = 1;
    result.behind = result.light[0];
    return result;
}

void add(const PixelLight& light, float part, PixelLight& sum) {
    add(light.light, part, sum.light);
    sum.open += light.open * part;
    sum.behind += light.behind * part;
}

void MeanLight::add(const PixelLight& ray) {
    cascade::add(ray, 1, sum_);
    const Colour tone = tone_of(ray.light);
    for (std::size_t c = 0; c < 3; ++c) {
        tones_[c] += tone[c];
        squares_[c] += tone[c] * tone[c];
    }
    ++count_;
}

PixelLight MeanLight::light() const {
    const float part = 1 / static_cast<float>(count_);
    PixelLight mean;
    cascade::add(sum_, part, mean);
    return mean;
}

float MeanLight::error() const {
    const auto n = static_cast<float>(count_);
    float most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        most = std::max(most, squares_[c] / n - tones_[c] / n * (tones_[c] / n));
    }
    return std::sqrt(most / n);
}

float MeanLight::error_of_open() const {
    const auto n = static_cast<float>(count_);
    const float part = sum_.open / n;
    return std::sqrt(part * (1 - part) / n);
}

void put(const PixelLight& light, bool has_background, std::int64_t x, std::int64_t y,
         Image& image) {
    Colour& pixel = image.at(x, y);
    if (has_background) {
        pixel = stored_of(light.light);
        return;
    }
    const float covered = 1 - light.open;
    const float shadow = light.open > 0 ? 1 - stored_of(light.behind / light.open) : 0;
    const float opacity = covered + light.open * shadow;
    image.alpha_at(x, y) = opacity;
    if (opacity < least_opacity) {
        pixel = transparent;
        return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        const float own = covered > 0 ? (light.light[c] - light.behind) / covered : 0;
        pixel[c] = stored_of(own) * (covered / opacity);
    }
}

}  // namespace cascade
