// The light of a pixel from its rays, and its conversion to colours of a picture.
#pragma once

#include "picture/image.h"
#include "render/tracer.h"

#include <cstdint>

namespace cascade {

/// Converts light to a perceptually uniform scale.
Colour tone_of(const Colour& light);

/// The light that comes from a hit to the camera. `sun` and `sky` are the fractions of the sun and
/// of the sky that are visible from the hit.
Colour light_of(const Seen& seen, float sun, float sky);

struct PixelLight {
    Colour light{};
    float open = 0;    ///< The fraction of the pixel without a surface, 0 … 1.
    float behind = 0;  ///< The light that a white background adds to each channel.
};

/// Adds the fraction `part` of a light to `sum`.
void add(const PixelLight& light, float part, PixelLight& sum);

/// The light of a pixel with a single ray.
PixelLight light_of_ray(const Seen& seen, float sun, float sky);

/// The mean light of several rays through a pixel, and an estimate of its error.
class MeanLight {
public:
    void add(const PixelLight& ray);
    PixelLight light() const;
    /// The standard error of the tone, computed as if the rays were chosen at random.
    float error() const;
    /// The standard error of the fraction without a surface.
    float error_of_open() const;

private:
    PixelLight sum_;
    Colour tones_{}, squares_{};
    int count_ = 0;
};

/// Sets a pixel. Without a background, surfaces are opaque where they cover the pixel. The rest of
/// the pixel is black, and as opaque as the shadow is dark. The two parts are blended in sRGB,
/// because other programs blend transparent pictures in this way.
void put(const PixelLight& light, bool has_background, std::int64_t x, std::int64_t y,
         Image& image);

}  // namespace cascade
