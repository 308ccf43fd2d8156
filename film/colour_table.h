// Chooses a few colours to represent many, for GIF files.
#pragma once

#include "film/film_frame.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Red, green and blue as one number: 0xrrggbb.
using PackedColour = std::uint32_t;

inline PackedColour packed(const unsigned char* pixel) {
    return PackedColour{pixel[0]} << 16 | PackedColour{pixel[1]} << 8 | pixel[2];
}

/// The different colours of the frame's opaque pixels, in ascending order. Empty if there are more
/// than `most`.
std::optional<std::vector<PackedColour>> few_colours(const FilmFrame& frame, std::size_t most);

/// At most `count` colours that represent the pixels of all frames. If the frames have at most
/// `count` colours, these are used unchanged. Otherwise the colours are divided into groups, and
/// each group is represented by its mean. The group with the largest variance is divided at its
/// mean until there are enough groups. This is a variant of median cut (P. Heckbert, "Color Image
/// Quantization for Frame Buffer Display", SIGGRAPH 1982).
std::vector<PackedColour> chosen_colours(std::span<const FilmFrame> frames, std::size_t count);

/// Finds the nearest colour in a table. Stores each result, so that equal colours are replaced in
/// the same way throughout a film. The distance is the sum of the squared differences of red, green
/// and blue in sRGB, with the weights 2, 4 and 3.
class NearestColours {
public:
    explicit NearestColours(std::vector<PackedColour> table);
    const std::vector<PackedColour>& table() const { return table_; }
    /// The index of the nearest colour in the table.
    std::uint8_t operator()(PackedColour colour);

private:
    std::vector<PackedColour> table_;
    /// For each colour, its index in the table plus 1, or 0 if the index is not known yet.
    std::vector<std::uint16_t> known_;
};

}  // namespace cascade
