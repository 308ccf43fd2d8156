// Draws a line of text in the corner of a picture, such as the step of a film's frame.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// Whether a picture of this size has room for a line of text on a light plate (see
/// draw_caption()).
bool has_room_for_caption(std::int64_t width, std::int64_t height);

/// Draws a line of text in the lower left corner, on a light plate so that it is legible on any
/// pattern. Text that is wider than the picture is cut off and ends in "…". has_room_for_caption()
/// must be true.
void draw_caption(Image& image, std::string_view text);

}  // namespace cascade
