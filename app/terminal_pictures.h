// Shows pictures in the terminal, in pixels if the terminal supports them, and otherwise in
// characters.
#pragma once

#include "app/console.h"
#include "picture/image.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

enum class PictureProtocol { characters, kitty, sixel };

struct TerminalPictures {
    PictureProtocol protocol = PictureProtocol::characters;
    int cell_width = 10, cell_height = 20;  ///< The size of a character in pixels.

    /// Returns the text that draws a picture. The picture is never higher than the window. If the
    /// terminal can show pixels, the picture replaces an earlier one with the same id.
    std::string draw(const Image& image, const Stream& out,
                     std::optional<std::uint32_t> id = std::nullopt) const;
    /// Returns the text that erases a picture of `lines` lines above the cursor, and moves the
    /// cursor to where the picture began.
    std::string erase(std::int64_t lines, std::uint32_t id) const;
};

/// Asks the terminal of `out` what it can show, and reads its answer from standard input. Waits for
/// at most one second. The variable CASCADE_PICTURES overrides the answer if it is kitty, sixel or
/// characters. The terminal is not asked if the stream has no colours or is no terminal.
TerminalPictures ask_terminal(const Stream& out);

/// Interprets the terminal's answers. `CSI ? … c` lists features. Feature 4 is sixels. `CSI 6 ; H ;
/// W t` gives the height and width of a character. `APC G … OK ST` means that kitty's protocol is
/// supported.
TerminalPictures understood(std::string_view answers);

}  // namespace cascade
