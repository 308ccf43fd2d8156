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
/// The distance from the left side of one glyph to the left side of the next.
inline constexpr int glyph_advance = 6;
/// The number of rows that a line needs below its glyphs, for descenders.
inline constexpr int deepest_drop = 2;

/// The dots of a character: one number for each row, from the top. Bit 4 is the leftmost dot.
using Glyph = std::array<std::uint8_t, glyph_height>;

/// The glyph of a character. Printable ASCII and the ellipsis U+2026 have glyphs. Any other
/// character is shown as a box.
const Glyph& glyph_of(char32_t character);

/// The number of rows by which the glyph is moved down. Only letters with a descender are moved.
int glyph_drop(char32_t character);

/// The characters of a UTF-8 label. U+FFFD replaces characters without a glyph. Invalid bytes are
/// dropped.
std::u32string label_characters(std::string_view label);

}  // namespace cascade
