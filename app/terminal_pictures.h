// How the terminal at hand shows pictures: in pixels if it can, else in characters.
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
    int cell_width = 10, cell_height = 20;  ///< Of a character, in pixels.

    /// A picture, never higher than the window, and as text in lines. In pixels, one with an id
    /// replaces an earlier one of that id.
    std::string draw(const Image& image, const Stream& out,
                     std::optional<std::uint32_t> id = std::nullopt) const;
    /// Takes back a picture of so many lines above the cursor, and leaves the cursor at its start.
    std::string erase(std::int64_t lines, std::uint32_t id) const;
};

/// Asks the terminal of `out`, whose answers come from standard input, and waits for a second at
/// most. CASCADE_PICTURES=kitty, sixel or characters decides instead. A stream without colours, or
/// one that is no terminal, is asked nothing.
TerminalPictures ask_terminal(const Stream& out);

/// What answers to the queries say: `CSI ? … c` lists features, of which 4 are sixels; `CSI 6 ; H ;
/// W t` is the size of a character; `APC G … OK ST` comes from kitty's protocol.
TerminalPictures understood(std::string_view answers);

}  // namespace cascade
