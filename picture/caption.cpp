// The font grows with the picture, in whole dots.
#include "picture/caption.h"

#include "core/check.h"
#include "picture/font.h"
#include "picture/lettering.h"

#include <algorithm>

namespace cascade {
namespace {

// The width of the picture, in pixels, for each dot of the font.
constexpr std::int64_t pixels_per_dot = 240;
constexpr std::int64_t largest_dot = 8;
constexpr std::int64_t padding = 3;  // The number of dots around the text.
constexpr std::int64_t least_characters = 4;

std::int64_t dot_of(std::int64_t width) {
    return std::clamp<std::int64_t>(width / pixels_per_dot, 1, largest_dot);
}

}  // namespace

bool has_room_for_caption(std::int64_t width, std::int64_t height) {
    const std::int64_t dot = dot_of(width), around = 2 * padding * dot;
    return width >= least_characters * glyph_advance * dot + around &&
           height >= text_height(dot) + around;
}

void draw_caption(Image& image, std::string_view text) {
    CHECK(has_room_for_caption(image.width, image.height), "the size was checked");
    const std::int64_t dot = dot_of(image.width), around = padding * dot;
    const std::int64_t room = image.width - 2 * around;
    const std::int64_t width = std::min(text_width(text, dot), room);
    const std::int64_t height = text_height(dot);
    const std::int64_t top = image.height - height - 2 * around;
    fill_rectangle(image, 0, top, width + 2 * around, height + 2 * around, sheet_ground);
    draw_text(image, text, around, top + around, room, dot);
}

}  // namespace cascade
