// The pixels of an image as the rows of a PNG file, before their compression (internal to
// picture/).
#pragma once

#include "picture/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
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
    bool operator==(const PngFormat&) const = default;
};

/// Filters rows in place. Each has a byte, which becomes the number of its filter, before `count`
/// bytes. A pixel has `pixel` bytes. Throws std::bad_alloc.
void filter_rows(std::span<std::uint8_t> rows, std::size_t count, std::size_t pixel);

/// Filtered rows, in the format with the fewest channels that holds all pixels.
struct PngRows {
    PngFormat format;
    std::vector<std::uint8_t> bytes;
};

/// All rows of an image. Throws std::bad_alloc.
PngRows png_rows(const Image& image, PngDepth depth);

/// The same for the image that paint() draws.
PngRows png_rows(const Painting& painting, PngDepth depth);

}  // namespace cascade
