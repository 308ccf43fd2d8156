// The pixels of an image as the rows of a PNG file, before their compression (internal to
// picture/).
#pragma once

#include "picture/image.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade {

/// How a PNG file stores pixels.
struct PngFormat {
    PngDepth depth = PngDepth::eight;
    bool is_grey = false;
    bool has_alpha = false;

    std::size_t sample_bytes() const { return static_cast<std::size_t>(depth) / 8; }
    std::size_t colours() const { return is_grey ? 1 : 3; }
    std::size_t pixel_bytes() const { return sample_bytes() * (colours() + (has_alpha ? 1 : 0)); }
};

/// The format with the fewest channels that holds all pixels.
PngFormat png_format(const Image& image, PngDepth depth);

/// All rows, each as the number of its filter and its filtered bytes. Throws std::bad_alloc.
std::vector<std::uint8_t> png_rows(const Image& image, const PngFormat& format);

}  // namespace cascade
