// Contact sheets: several pictures side by side, each with a line of text under it.
#include "core/check.h"
#include "picture/font.h"
#include "picture/image.h"

#include <algorithm>
#include <cstddef>

namespace cascade {
namespace {

constexpr Colour ground{0.96F, 0.955F, 0.94F};
constexpr Colour frame{0.72F, 0.71F, 0.69F};
constexpr Colour ink{0.16F, 0.16F, 0.17F};

constexpr std::int64_t comfortable_side = 192;  // Pictures below half of it are enlarged.
constexpr std::int64_t least_height = 24;       // A line of cells becomes a band so high.
constexpr std::int64_t margin = 16;             // Around the panels and between them.
constexpr std::int64_t label_gap = 6;           // Between a picture's frame and its label.

/// Sizes in pixels that all panels of one sheet share.
struct Sizes {
    std::int64_t enlarge = 1;  ///< Every picture's factor.
    std::int64_t width = 0;    ///< Of the widest picture, enlarged.
    std::int64_t height = 0;   ///< Of the highest picture, enlarged.
    std::int64_t dot = 1;      ///< Side of one dot of the font.
};

std::int64_t shown_height(const Image& image, std::int64_t factor) {
    return std::max(image.height * factor, least_height);
}

Sizes sizes_of(std::span<const Panel> panels) {
    std::int64_t longest = 1;
    for (const Panel& panel : panels) {
        longest = std::max({longest, panel.image.width, panel.image.height});
    }
    Sizes sizes;
    sizes.enlarge = std::max<std::int64_t>(1, comfortable_side / longest);
    for (const Panel& panel : panels) {
        sizes.width = std::max(sizes.width, panel.image.width * sizes.enlarge);
        sizes.height = std::max(sizes.height, shown_height(panel.image, sizes.enlarge));
    }
    sizes.width = std::max(sizes.width, comfortable_side / 2);
    sizes.dot = std::clamp<std::int64_t>(sizes.width / 96, 1, 3);
    return sizes;
}

/// Pixels (x, y) … (x + width − 1, y + height − 1), all within the sheet.
void fill(Image& sheet, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
          Colour colour) {
    for (std::int64_t j = y; j < y + height; ++j) std::fill_n(&sheet.at(x, j), width, colour);
}

void draw_picture(Image& sheet, const Image& image, std::int64_t x, std::int64_t y,
                  const Sizes& sizes) {
    const std::int64_t width = image.width * sizes.enlarge;
    const std::int64_t height = shown_height(image, sizes.enlarge);
    fill(sheet, x - 1, y - 1, width + 2, height + 2, frame);
    for (std::int64_t j = 0; j < height; ++j) {
        // Rows follow the factor, or are spread over the band of a picture of few rows.
        const std::int64_t row = j * image.height / height;
        for (std::int64_t i = 0; i < width; ++i) {
            sheet.at(x + i, y + j) = image.at(i / sizes.enlarge, row);
        }
    }
}

void draw_label(Image& sheet, std::string_view label, std::int64_t x, std::int64_t y,
                const Sizes& sizes) {
    std::u32string characters = label_characters(label);
    // The last character needs no room behind it.
    const std::int64_t gap = glyph_advance - glyph_width;
    const auto fitting = static_cast<std::size_t>((sizes.width / sizes.dot + gap) / glyph_advance);
    if (characters.size() > fitting) {
        characters.resize(fitting);
        characters.back() = U'\u2026';
    }
    for (const char32_t character : characters) {
        const Glyph& glyph = glyph_of(character);
        const std::int64_t top = y + glyph_drop(character) * sizes.dot;
        for (int row = 0; row < glyph_height; ++row) {
            for (int column = 0; column < glyph_width; ++column) {
                const unsigned bit = 1U << (glyph_width - 1 - column);
                if ((glyph[static_cast<std::size_t>(row)] & bit) == 0) continue;
                fill(sheet, x + column * sizes.dot, top + row * sizes.dot, sizes.dot, sizes.dot,
                     ink);
            }
        }
        x += glyph_advance * sizes.dot;
    }
}

}  // namespace

Image make_sheet(std::span<const Panel> panels, int columns) {
    CHECK(!panels.empty() && columns >= 1, "a sheet has panels and columns");
    const auto count = static_cast<std::int64_t>(panels.size());
    const std::int64_t across = std::min<std::int64_t>(columns, count);
    const std::int64_t down = (count + across - 1) / across;
    const Sizes sizes = sizes_of(panels);
    const std::int64_t panel_width = sizes.width + margin;
    const std::int64_t label_height = label_gap + (glyph_height + deepest_drop) * sizes.dot;
    const std::int64_t panel_height = sizes.height + label_height + margin;
    Image sheet(across * panel_width + margin, down * panel_height + margin, ground);
    for (std::int64_t k = 0; k < count; ++k) {
        const Panel& panel = panels[static_cast<std::size_t>(k)];
        const std::int64_t x = margin + k % across * panel_width;
        const std::int64_t y = margin + k / across * panel_height;
        draw_picture(sheet, panel.image, x, y, sizes);
        // Directly under its picture, also where the next one is higher.
        const std::int64_t label_y = y + shown_height(panel.image, sizes.enlarge) + label_gap;
        draw_label(sheet, panel.label, x, label_y, sizes);
    }
    return sheet;
}

}  // namespace cascade
