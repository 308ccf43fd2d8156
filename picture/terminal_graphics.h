// Pictures as control sequences of terminals that show pixels.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// The picture averaged down in proportion to `width` columns, at most its own.
Image reduce(const Image& image, std::int64_t width);

/// The picture in kitty's graphics protocol, as a PNG in base64, at one pixel per pixel. The cursor
/// does not move, and the terminal sends no answer. With an id, it replaces an earlier picture with
/// that id. Empty if it cannot be encoded.
std::string kitty_picture(const Image& image, std::optional<std::uint32_t> id = std::nullopt);

/// Removes a picture with an id, wherever it is shown.
std::string without_kitty_picture(std::uint32_t id);

/// The picture in DEC's sixels: bands of six rows, in at most 256 colours. Colours are rounded to
/// fewer levels if there are more. The final position of the cursor depends on the terminal. Pixels
/// that are less than half opaque stay as they are.
std::string sixel_picture(const Image& image);

}  // namespace cascade
