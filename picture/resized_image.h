// Images with another number of pixels.
#pragma once

#include "picture/image.h"

#include <cstdint>

namespace cascade {

/// The image with another number of columns and rows, at least 1 each. Each pixel is the mean of
/// the part of the image that it covers, weighted by opacity.
Image resized(const Image& image, std::int64_t width, std::int64_t height);

/// The image in the middle of a larger one, which is transparent around it.
Image in_the_middle(const Image& image, std::int64_t width, std::int64_t height);

}  // namespace cascade
