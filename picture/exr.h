// Writes OpenEXR files, by which film and 3-D programs exchange pictures whose numbers are not
// limited to 0 … 1 (Academy Software Foundation, "OpenEXR File Layout", 2023).
#pragma once

#include "core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace cascade {

/// A channel of a picture. It has one number for each pixel.
struct ExrChannel {
    /// "R", "G", "B" or "A". "Y" if a picture has only one number per pixel.
    std::string name;
    const float* first = nullptr;  ///< The number of the upper left pixel.
    /// The number of elements in memory from one pixel to the next. The last pixel of a row is just
    /// as far from the first pixel of the next row.
    std::size_t step = 1;
    bool is_half = true;  ///< Whether numbers are stored with 16 bits instead of 32.
};

/// Encodes a file in memory, with rows from the top, compressed without loss in blocks of 16 rows
/// (ZIP). `width` and `height` must be 1 … 2^31 − 1. Channels must have different names and `width`
/// × `height` numbers each. Fails if memory is exhausted.
Result<std::string> encode_exr(std::int64_t width, std::int64_t height,
                               std::span<const ExrChannel> channels);

}  // namespace cascade
