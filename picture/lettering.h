// Text and rectangles on an image, for contact sheets and maps.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// Colours of sheets.
inline constexpr Colour sheet_ground{0.96F, 0.955F, 0.94F};
inline constexpr Colour sheet_frame{0.72F, 0.71F, 0.69F};
inline constexpr Colour sheet_ink{0.16F, 0.16F, 0.17F};

/// Pixels around the content of a sheet or map.
inline constexpr std::int64_t sheet_margin = 16;
/// The height in pixels of the band drawn for a line of cells.
inline constexpr std::int64_t least_band_height = 24;

/// Fills pixels (x, y) … (x + width − 1, y + height − 1), which must be within the image.
void fill_rectangle(Image& image, std::int64_t x, std::int64_t y, std::int64_t width,
                    std::int64_t height, Colour colour);

/// The width in pixels of a line of text, if each dot of the font is `dot` pixels wide.
std::int64_t text_width(std::string_view text, std::int64_t dot);
/// The height in pixels of a line of text, including descenders.
std::int64_t text_height(std::int64_t dot);

/// Draws a line of UTF-8 text with its upper left corner at (x, y). Text wider than `room` ends in
/// "…". Draws nothing if not even that fits.
void draw_text(Image& image, std::string_view text, std::int64_t x, std::int64_t y,
               std::int64_t room, std::int64_t dot);

/// Draws a picture enlarged by `factor` in a frame of one pixel. `height` is the height of the
/// enlarged picture, or of the band to which a picture of few rows is stretched.
void draw_framed(Image& image, const Image& picture, std::int64_t x, std::int64_t y,
                 std::int64_t factor, std::int64_t height);

}  // namespace cascade
