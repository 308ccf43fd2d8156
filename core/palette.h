// Named colour maps: greys, perceptual maps and animal coats.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// Red, green and blue as stored in a picture (sRGB), each 0 … 1.
using Colour = std::array<float, 3>;

/// The colour for NaN: magenta, unlike the colours of all palettes.
inline constexpr Colour colour_of_nan{1.0F, 0.0F, 1.0F};

/// Colours at equal distances from 0 to 1, interpolated linearly in sRGB.
struct Palette {
    std::string_view name;
    std::string_view description;  ///< For `--help` and the spec.
    /// At least two colours, at equal distances from position 0 to position 1.
    std::span<const Colour> stops;
};

/// All palettes, "grey" first.
std::span<const Palette> palettes();

/// The palette called `name`, or the palette whose 2 to 64 colours `name` lists in hexadecimal form
/// with blanks between them, such as "#1b2a49 #f08a5d #fff3d6" or "#000 #fff". nullptr if `name` is
/// neither. A palette is never destroyed.
const Palette* find_palette(std::string_view name);

/// Reads a colour such as "#1b2a49" or "#fff". Returns nullopt for other words.
std::optional<Colour> find_colour(std::string_view word);
/// A colour as a text such as "#1b2a49", with each channel rounded to 256 levels.
std::string hexadecimal(const Colour& colour);

/// The colour at `position`, clamped to 0 … 1; colour_of_nan for NaN.
Colour colour_at(const Palette& palette, double position);

}  // namespace cascade
