// Glyphs are bitmaps, whose dots are drawn as squares of whole pixels. Text that is too long ends
// in an ellipsis.
#include "picture/lettering.h"

#include "picture/font.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace cascade {

namespace {

void draw_glyph(Image& image, char32_t character, std::int64_t x, std::int64_t y,
                std::int64_t dot) {
    const Glyph& glyph = glyph_of(character);
    const std::int64_t top = y + glyph_drop(character) * dot;
    for (int row = 0; row < glyph_height; ++row) {
        for (int column = 0; column < glyph_width; ++column) {
            const unsigned bit = 1U << (glyph_width - 1 - column);
            if ((glyph[static_cast<std::size_t>(row)] & bit) == 0) continue;
            fill_rectangle(image, x + column * dot, top + row * dot, dot, dot, sheet_ink);
        }
    }
}

}  // namespace

void fill_rectangle(Image& image, std::int64_t x, std::int64_t y, std::int64_t width,
                    std::int64_t height, Colour colour) {
    for (std::int64_t j = y; j < y + height; ++j) {
        std::fill_n(&image.at(x, j), width, colour);
        if (!image.alpha.empty()) std::fill_n(&image.alpha_at(x, j), width, 1.0F);
    }
}

std::int64_t text_width(std::string_view text, std::int64_t dot) {
    const auto count = static_cast<std::int64_t>(label_characters(text).size());
    // The last character needs no gap after it.
    return count == 0 ? 0 : (count * glyph_advance - (glyph_advance - glyph_width)) * dot;
}

std::int64_t text_height(std::int64_t dot) { return (glyph_height + deepest_drop) * dot; }

void draw_text(Image& image, std::string_view text, std::int64_t x, std::int64_t y,
               std::int64_t room, std::int64_t dot) {
    std::u32string characters = label_characters(text);
    const std::int64_t gap = glyph_advance - glyph_width;
    const std::int64_t fitting = (std::max<std::int64_t>(room, 0) / dot + gap) / glyph_advance;
    if (static_cast<std::int64_t>(characters.size()) > fitting) {
        characters.resize(static_cast<std::size_t>(fitting));
        if (!characters.empty()) characters.back() = U'\u2026';
    }
    for (const char32_t character : characters) {
        draw_glyph(image, character, x, y, dot);
        x += glyph_advance * dot;
    }
}

void draw_framed(Image& image, const Image& picture, std::int64_t x, std::int64_t y,
                 std::int64_t factor, std::int64_t height) {
    const std::int64_t width = picture.width * factor;
    fill_rectangle(image, x - 1, y - 1, width + 2, height + 2, sheet_frame);
    for (std::int64_t j = 0; j < height; ++j) {
        // Enlarges rows by `factor`, or stretches a picture with few rows to a band.
        const std::int64_t row = j * picture.height / height;
        for (std::int64_t i = 0; i < width; ++i) {
            image.at(x + i, y + j) = picture.over(sheet_ground, i / factor, row);
        }
    }
}

}  // namespace cascade
