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
inline constexpr int glyph_advance = 6;  ///< From a glyph's left side to the next one's.
inline constexpr int deepest_drop = 2;   ///< Rows that a line needs below its glyphs.

/// Rows from the top; bit 4 is the leftmost dot.
using Glyph = std::array<std::uint8_t, glyph_height>;

/// Printable ASCII and the ellipsis U+2026; a box for every other character.
const Glyph& glyph_of(char32_t character);

/// By how many rows a glyph is drawn lower than the others: the letters with a tail.
int glyph_drop(char32_t character);

/// The characters of a UTF-8 label as far as the font tells them apart: all that it has no glyph
/// for become U+FFFD, bytes that continue nothing are left out.
std::u32string label_characters(std::string_view label);

}  // namespace cascade
