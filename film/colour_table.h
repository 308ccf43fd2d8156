// Chooses few colours to represent many, for GIF files.
#pragma once

#include "film/film_frame.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Red, green and blue as a number: 0xrrggbb.
using PackedColour = std::uint32_t;

inline PackedColour packed(const unsigned char* pixel) {
    return PackedColour{pixel[0]} << 16 | PackedColour{pixel[1]} << 8 | pixel[2];
}

/// The colours of the frame, in ascending order, without its transparent pixels; nullopt if there
/// are more than `most`.
std::optional<std::vector<PackedColour>> few_colours(const FilmFrame& frame, std::size_t most);

/// At most `count` colours for the pixels of all frames together: their own if they have no more,
/// else the means of groups. Groups are divided where their colours are spread most, until there
/// are enough (median cut: P. Heckbert, "Color Image Quantization for Frame Buffer Display",
/// SIGGRAPH 1982; here the group with the largest variance is divided at its mean).
std::vector<PackedColour> chosen_colours(std::span<const FilmFrame> frames, std::size_t count);

/// Finds the nearest colour of a table, and remembers it, so that equal colours are replaced
/// equally in all of a film. Distances are between red, green and blue in sRGB, weighted 2 : 4 : 3.
class NearestColours {
public:
    explicit NearestColours(std::vector<PackedColour> table);
    const std::vector<PackedColour>& table() const { return table_; }
    /// The number of the colour in the table.
    std::uint8_t operator()(PackedColour colour);

private:
    std::vector<PackedColour> table_;
    std::vector<std::uint16_t> known_;  ///< For every colour: 1 + number in the table, or 0.
};

}  // namespace cascade
