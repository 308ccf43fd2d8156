// OpenEXR files: numbers of any size, as film and 3-D programs exchange them (Academy Software
// Foundation, "OpenEXR File Layout", 2023).
#pragma once

#include "core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace cascade {

/// One number per pixel.
struct ExrChannel {
    std::string name;              ///< "R", "G", "B", "A"; "Y" for a picture of one number.
    const float* first = nullptr;  ///< The upper left pixel's number.
    std::size_t step = 1;          ///< From one pixel to the next in a row, and over rows.
    bool is_half = true;           ///< Stored with 16 bits instead of 32.
};

/// The file in memory: rows from the top, compressed without loss in blocks of 16 rows (ZIP). Each
/// side is 1 … 2^31 − 1. Channels have different names and `width` × `height` numbers each. Fails
/// if memory runs out.
Result<std::string> encode_exr(std::int64_t width, std::int64_t height,
                               std::span<const ExrChannel> channels);

}  // namespace cascade
