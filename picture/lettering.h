// Text and rectangles on an image: what contact sheets and maps are labelled with.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// Colours of sheets.
inline constexpr Colour sheet_ground{0.96F, 0.955F, 0.94F};
inline constexpr Colour sheet_frame{0.72F, 0.71F, 0.69F};
inline constexpr Colour sheet_ink{0.16F, 0.16F, 0.17F};

/// Pixels (x, y) … (x + width − 1, y + height − 1), all within the image.
void fill_rectangle(Image& image, std::int64_t x, std::int64_t y, std::int64_t width,
                    std::int64_t height, Colour colour);

/// Pixels that a line of text takes, each dot of the font `dot` pixels wide.
std::int64_t text_width(std::string_view text, std::int64_t dot);
/// Pixels from the top of a line to the lowest letter's end.
std::int64_t text_height(std::int64_t dot);

/// A line of UTF-8 text whose upper left corner is at (x, y). What is wider than `room` ends in
/// "…"; where not even that fits, nothing is drawn.
void draw_text(Image& image, std::string_view text, std::int64_t x, std::int64_t y,
               std::int64_t room, std::int64_t dot);

/// A picture with every pixel as a square of `factor` pixels, a frame of one pixel around it. Of a
/// picture of few rows a band of `height` pixels is made; else `height` is that of the picture,
/// enlarged.
void draw_framed(Image& image, const Image& picture, std::int64_t x, std::int64_t y,
                 std::int64_t factor, std::int64_t height);

}  // namespace cascade
