// Images with another number of pixels.
#pragma once

#include "picture/image.h"

#include <cstdint>

namespace cascade {

/// The image with another number of columns and rows, at least 1 each. Each pixel is the mean of
/// the part of the image that it covers, weighted by opacity.
Image resized(const Image& image, std::int64_t width, std::int64_t height);

/// A larger image with this image in its middle. The new pixels are transparent.
Image in_the_middle(const Image& image, std::int64_t width, std::int64_t height);

}  // namespace cascade
