// A frame of a film as bytes, and its changes from the previous frame.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <string>

namespace cascade {

/// Red, green, blue and alpha of each pixel, one byte each, in rows from the top. Pixels with alpha
/// 0 are white, so that players that ignore alpha show white.
struct FilmFrame {
    std::int64_t width = 0, height = 0;
    std::string pixels;

    static constexpr std::size_t pixel_bytes = 4;
    /// The bytes of row y from pixel x on.
    const unsigned char* row(std::int64_t y, std::int64_t x = 0) const {
        return reinterpret_cast<const unsigned char*>(pixels.data()) +
               static_cast<std::size_t>(y * width + x) * pixel_bytes;
    }
};

/// Makes a frame of an image. Colours are rounded as in PNG files of 8 bits. Throws std::bad_alloc.
FilmFrame film_frame(const Image& image);

/// Whether a pixel is less than half opaque. Formats without partial opacity make such a pixel
/// transparent.
inline bool is_hole(const unsigned char* pixel) { return pixel[3] < 128; }

/// Whether the frame has a pixel that is less than half opaque.
bool has_holes(const FilmFrame& frame);

/// Whether any pixel is not completely opaque.
bool has_alpha(const FilmFrame& frame);

/// A part of a frame, in pixels.
struct FramePart {
    std::int64_t x = 0, y = 0, width = 0, height = 0;
    bool operator==(const FramePart&) const = default;
};

inline FramePart whole_of(const FilmFrame& frame) { return {0, 0, frame.width, frame.height}; }

/// The smallest rectangle that contains all differences between two frames of the same size. If the
/// frames are equal, this is the first pixel, because films cannot contain empty pictures.
FramePart changed_part(const FilmFrame& before, const FilmFrame& now);

}  // namespace cascade
