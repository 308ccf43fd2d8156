// Compares frames row by row from the top and the bottom, and then from both sides.
#include "film/film_frame.h"

#include "picture/srgb.h"

#include <algorithm>
#include <cstring>

namespace cascade {

FilmFrame film_frame(const Image& image) {
    FilmFrame frame{image.width, image.height, {}};
    frame.pixels.resize(image.pixels.size() * FilmFrame::pixel_bytes);
    char* out = frame.pixels.data();
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            const unsigned alpha = level_of(image.opacity(x, y), 255);
            for (const float value : image.at(x, y))
                *out++ = static_cast<char>(alpha > 0 ? level_of(value, 255) : 255);
            *out++ = static_cast<char>(alpha);
        }
    }
    return frame;
}

namespace {

template <typename Test>
bool has_pixel(const FilmFrame& frame, const Test& test) {
    const unsigned char* pixel = frame.row(0);
    const unsigned char* const end = pixel + frame.pixels.size();
    for (; pixel != end; pixel += FilmFrame::pixel_bytes) {
        if (test(pixel)) return true;
    }
    return false;
}

}  // namespace

bool has_holes(const FilmFrame& frame) { return has_pixel(frame, is_hole); }

bool has_alpha(const FilmFrame& frame) {
    return has_pixel(frame, [](const unsigned char* pixel) { return pixel[3] < 255; });
}

FramePart changed_part(const FilmFrame& before, const FilmFrame& now) {
    const auto differ = [&](std::int64_t x, std::int64_t y, std::int64_t width) {
        return std::memcmp(before.row(y, x), now.row(y, x),
                           static_cast<std::size_t>(width) * FilmFrame::pixel_bytes) != 0;
    };
    std::int64_t top = 0, bottom = now.height;
    while (top < bottom && !differ(0, top, now.width)) ++top;
    if (top == bottom) return {0, 0, 1, 1};
    while (!differ(0, bottom - 1, now.width)) --bottom;
    std::int64_t left = now.width, right = 0;
    for (std::int64_t y = top; y < bottom; ++y) {
        for (std::int64_t x = 0; x < left; ++x) {
            if (differ(x, y, 1)) left = x;
        }
        for (std::int64_t x = now.width; x > right; --x) {
            if (differ(x - 1, y, 1)) right = x;
        }
    }
    return {left, top, right - left, bottom - top};
}

}  // namespace cascade
