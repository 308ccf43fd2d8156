// A frame of a film in bytes, and its changes from the previous frame.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <string>

namespace cascade {

/// Red, green, blue and alpha of each pixel, a byte each, rows from the top. Pixels whose alpha is
/// 0 are white, for players that ignore it.
struct FilmFrame {
    std::int64_t width = 0, height = 0;
    std::string pixels;

    static constexpr std::size_t pixel_bytes = 4;
    /// The bytes of row y, beginning at pixel x.
    const unsigned char* row(std::int64_t y, std::int64_t x = 0) const {
        return reinterpret_cast<const unsigned char*>(pixels.data()) +
               static_cast<std::size_t>(y * width + x) * pixel_bytes;
    }
};

/// The image with each colour rounded as in PNG files of 8 bits. Throws std::bad_alloc.
FilmFrame film_frame(const Image& image);

/// Whether a pixel counts as transparent if it cannot be translucent: less than half opaque.
inline bool is_hole(const unsigned char* pixel) { return pixel[3] < 128; }

/// True if there is such a pixel.
bool has_holes(const FilmFrame& frame);

/// True if a pixel is not entirely opaque.
bool has_alpha(const FilmFrame& frame);

/// A part of a frame, in pixels.
struct FramePart {
    std::int64_t x = 0, y = 0, width = 0, height = 0;
    bool operator==(const FramePart&) const = default;
};

inline FramePart whole_of(const FilmFrame& frame) { return {0, 0, frame.width, frame.height}; }

/// The smallest rectangle that contains all differences of two frames of one size. The first pixel
/// if they are equal, since films have no empty pictures.
FramePart changed_part(const FilmFrame& before, const FilmFrame& now);

}  // namespace cascade
