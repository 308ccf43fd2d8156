// Converts an image to the rows of a PNG file before compression. Only the files of picture/
// include this header.
#pragma once

#include "picture/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The format in which a PNG file stores pixels.
struct PngFormat {
    PngDepth depth = PngDepth::eight;
    bool is_grey = false;
    bool has_alpha = false;

    std::size_t sample_bytes() const { return static_cast<std::size_t>(depth) / 8; }
    std::size_t colours() const { return is_grey ? 1 : 3; }
    std::size_t pixel_bytes() const { return sample_bytes() * (colours() + (has_alpha ? 1 : 0)); }
    bool operator==(const PngFormat&) const = default;
};

/// Applies PNG's filters to rows, in place. Each row has one byte that receives the number of its
/// filter, followed by `count` bytes. A pixel has `pixel` bytes. Throws std::bad_alloc.
void filter_rows(std::span<std::uint8_t> rows, std::size_t count, std::size_t pixel);

/// The filtered rows of an image, in the format with the fewest channels that can represent all
/// pixels.
struct PngRows {
    PngFormat format;
    std::vector<std::uint8_t> bytes;
};

/// Converts all rows of an image. Throws std::bad_alloc.
PngRows png_rows(const Image& image, PngDepth depth);

/// Converts all rows of the image that paint() would draw.
PngRows png_rows(const Painting& painting, PngDepth depth);

}  // namespace cascade
