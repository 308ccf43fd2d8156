// Draws images with the control sequences of terminals that can show pixels.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// Reduces an image in proportion, by averaging, until it has `width` columns. `width` must not
/// exceed the image's width.
Image reduce(const Image& image, std::int64_t width);

/// Draws an image with kitty's graphics protocol, as a PNG in base64, without enlarging it. The
/// cursor does not move, and the terminal sends no answer. If `id` is given, the image replaces an
/// earlier image with the same id. Empty if the image cannot be encoded.
std::string kitty_picture(const Image& image, std::optional<std::uint32_t> id = std::nullopt);

/// Removes the image with this id from the terminal.
std::string without_kitty_picture(std::uint32_t id);

/// Draws an image in DEC's sixel format: bands of six rows, in at most 256 colours. If the image
/// has more colours, each channel is rounded to fewer values. The position of the cursor afterwards
/// depends on the terminal. Pixels that are less than half opaque leave the screen as it is.
std::string sixel_picture(const Image& image);

}  // namespace cascade
