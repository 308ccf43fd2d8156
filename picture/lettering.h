// Draws texts and rectangles on an image, for contact sheets and maps.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// The colours of contact sheets.
inline constexpr Colour sheet_ground{0.96F, 0.955F, 0.94F};
inline constexpr Colour sheet_frame{0.72F, 0.71F, 0.69F};
inline constexpr Colour sheet_ink{0.16F, 0.16F, 0.17F};

/// The number of pixels around the content of a sheet or map.
inline constexpr std::int64_t sheet_margin = 16;
/// The least height, in pixels, of a picture on a sheet. A picture with fewer rows, such as the
/// picture of a line of cells, is stretched to a band of this height.
inline constexpr std::int64_t least_band_height = 24;

/// Fills the pixels (x, y) … (x + width − 1, y + height − 1), all of which must be in the image.
void fill_rectangle(Image& image, std::int64_t x, std::int64_t y, std::int64_t width,
                    std::int64_t height, Colour colour);

/// The width of a line of text in pixels. Each dot of the font is `dot` pixels wide.
std::int64_t text_width(std::string_view text, std::int64_t dot);
/// The height of a line of text in pixels, including descenders.
std::int64_t text_height(std::int64_t dot);

/// Draws a line of UTF-8 text with its upper left corner at (x, y). If the text is wider than
/// `room` pixels, it is cut off and ends in "…". If there is no room for "…" either, nothing is
/// drawn.
void draw_text(Image& image, std::string_view text, std::int64_t x, std::int64_t y,
               std::int64_t room, std::int64_t dot);

/// Draws a picture, enlarged by `factor`, in a frame of one pixel. The drawn picture is `height`
/// pixels high. If this is more than `factor` times its rows, the picture is stretched to a band of
/// this height.
void draw_framed(Image& image, const Image& picture, std::int64_t x, std::int64_t y,
                 std::int64_t factor, std::int64_t height);

}  // namespace cascade
