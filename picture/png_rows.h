// The pixels of an image as the rows of a PNG file, before their compression (internal to
// picture/).
#pragma once

#include "picture/image.h"

#include <cstddef>
#include <cstdint>
#include <functional>
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

/// Writes the samples of row `y` of a picture to `out`.
using PutRow = std::function<void(std::int64_t y, std::uint8_t* out)>;

/// `height` rows of `count` bytes, each as the number of its filter and its filtered bytes. A pixel
/// has `pixel` bytes. Throws std::bad_alloc.
std::vector<std::uint8_t> filtered_rows(std::int64_t height, std::size_t count, std::size_t pixel,
                                        const PutRow& put);

/// All rows of an image, each as the number of its filter and its filtered bytes. Throws
/// std::bad_alloc.
std::vector<std::uint8_t> png_rows(const Image& image, const PngFormat& format);

}  // namespace cascade
