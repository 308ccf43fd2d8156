// A font of 5 × 7 dots for the labels of contact sheets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace cascade {

inline constexpr int glyph_width = 5;
inline constexpr int glyph_height = 7;
inline constexpr int glyph_advance = 6;  ///< From the left side of one glyph to the next.
inline constexpr int deepest_drop = 2;   ///< Rows that a line needs below its glyphs.

/// Rows from the top. Bit 4 is the leftmost dot.
using Glyph = std::array<std::uint8_t, glyph_height>;

/// Printable ASCII and the ellipsis U+2026; a box for any other character.
const Glyph& glyph_of(char32_t character);

/// The number of rows by which letters with descenders are lowered.
int glyph_drop(char32_t character);

/// The characters of a UTF-8 label. Those without a glyph become U+FFFD. Stray bytes are dropped.
std::u32string label_characters(std::string_view label);

}  // namespace cascade
