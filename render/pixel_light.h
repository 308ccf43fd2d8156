// The light of a pixel from that of its rays, and what it becomes in a picture.
#pragma once

#include "picture/image.h"
#include "render/tracer.h"

#include <cstdint>

namespace cascade {

/// What eyes take for evenly spaced.
Colour tone_of(const Colour& light);

/// What a hit sends to the camera if it sees these parts of the sun and of the sky.
Colour light_of(const Seen& seen, float sun, float sky);

struct PixelLight {
    Colour light{};
    float open = 0;    ///< The part of the pixel in which no surface is seen, 0 … 1.
    float behind = 0;  ///< What it adds to each channel of `light` if the background is white.
};

/// Adds a part of a light to a sum.
void add(const PixelLight& light, float part, PixelLight& sum);

/// The light of a pixel with a single ray.
PixelLight light_of_ray(const Seen& seen, float sun, float sky);

/// The mean of rays through a pixel, and how far it may be off.
class MeanLight {
public:
    void add(const PixelLight& ray);
    PixelLight light() const;
    /// The standard error of the tone, as if rays were random.
    float error() const;
    /// The same of the part in which no surface is seen.
    float error_of_open() const;

private:
    PixelLight sum_;
    Colour tones_{}, squares_{};
    int count_ = 0;
};

/// Sets a pixel. Without a background, surfaces cover their part of it, and the rest is black, as
/// opaque as it is in shadow. The two are blended in sRGB, as other programs do.
void put(const PixelLight& light, bool has_background, std::int64_t x, std::int64_t y,
         Image& image);

}  // namespace cascade
