// Computes the positions of tiles, labels and margins in whole pixels, and then draws them.
#include "picture/map.h"

#include "core/check.h"
#include "picture/lettering.h"

#include <algorithm>
#include <cstddef>

namespace cascade {

namespace {

constexpr std::int64_t comfortable_tile = 128;  // Pictures smaller than half of this are enlarged.
// Pixels between tiles, and between tiles and labels.
constexpr std::int64_t gap = 6;
constexpr Colour empty_place{0.90F, 0.893F, 0.875F};

/// Positions and sizes in pixels.
struct MapLayout {
    std::int64_t factor = 1, dot = 1;
    std::int64_t tile_width = 0, tile_height = 0;
    std::int64_t left = sheet_margin;  ///< The left side of the first column of tiles.
    std::int64_t top = sheet_margin;   ///< The upper side of the top row of tiles.
    std::int64_t width = 0, height = 0;
};

bool is_empty(const Image& image) { return image.width == 0; }

void lay_out_tiles(std::span<const MapTile> tiles, MapLayout& layout) {
    std::int64_t longest = 1;
    for (const MapTile& tile : tiles) {
        longest = std::max({longest, tile.image.width, tile.image.height});
    }
    layout.factor = std::max<std::int64_t>(1, comfortable_tile / longest);
    for (const MapTile& tile : tiles) {
        layout.tile_width = std::max(layout.tile_width, tile.image.width * layout.factor);
        layout.tile_height = std::max(layout.tile_height, tile.image.height * layout.factor);
    }
    if (layout.tile_width == 0) layout.tile_width = layout.tile_height = comfortable_tile;
    layout.tile_height = std::max(layout.tile_height, least_band_height);
    layout.dot = std::clamp<std::int64_t>(layout.tile_width / 96, 1, 3);
}

MapLayout lay_out(std::span<const MapTile> tiles, const MapAxis& across, const MapAxis& up) {
    MapLayout layout;
    lay_out_tiles(tiles, layout);
    const std::int64_t line = text_height(layout.dot) + gap;
    if (!up.name.empty()) {
        std::int64_t widest = 0;
        for (const std::string& value : up.values) {
            widest = std::max(widest, text_width(value, layout.dot));
        }
        layout.left += widest + 2 * gap;
        layout.top += line + gap;  // The name of the axis is above its values.
    }
    const auto columns = static_cast<std::int64_t>(across.values.size());
    const auto rows = static_cast<std::int64_t>(up.values.size());
    const std::int64_t tiles_width = columns * (layout.tile_width + gap) - gap;
    const std::int64_t needed =
        std::max({layout.left + tiles_width, sheet_margin + text_width(up.name, layout.dot),
                  layout.left + text_width(across.name, layout.dot)});
    layout.width = needed + sheet_margin;
    layout.height = layout.top + rows * (layout.tile_height + gap) - gap + sheet_margin;
    if (!across.name.empty()) layout.height += 2 * line + gap;
    return layout;
}

/// Draws text centred between x and x + width.
void draw_centred(Image& map, const std::string& text, std::int64_t x, std::int64_t width,
                  std::int64_t y, std::int64_t dot) {
    const std::int64_t taken = std::min(text_width(text, dot), width);
    draw_text(map, text, x + (width - taken) / 2, y, width, dot);
}

void draw_tile(Image& map, const MapTile& tile, const MapLayout& layout, std::int64_t x,
               std::int64_t y) {
    if (!is_empty(tile.image)) {
        draw_framed(map, tile.image, x, y, layout.factor,
                    std::max(tile.image.height * layout.factor, least_band_height));
        return;
    }
    fill_rectangle(map, x - 1, y - 1, layout.tile_width + 2, layout.tile_height + 2, sheet_frame);
    fill_rectangle(map, x, y, layout.tile_width, layout.tile_height, empty_place);
    draw_centred(map, tile.remark, x + gap, layout.tile_width - 2 * gap,
                 y + (layout.tile_height - text_height(layout.dot)) / 2, layout.dot);
}

void draw_axes(Image& map, const MapAxis& across, const MapAxis& up, const MapLayout& layout) {
    const std::int64_t line = text_height(layout.dot) + gap;
    const auto rows = static_cast<std::int64_t>(up.values.size());
    if (!up.name.empty()) {
        draw_text(map, up.name, sheet_margin, sheet_margin, layout.width - 2 * sheet_margin,
                  layout.dot);
        for (std::int64_t row = 0; row < rows; ++row) {
            const std::string& value = up.values[static_cast<std::size_t>(row)];
            const std::int64_t width = text_width(value, layout.dot);
            const std::int64_t y = layout.top + (rows - 1 - row) * (layout.tile_height + gap) +
                                   (layout.tile_height - text_height(layout.dot)) / 2;
            draw_text(map, value, layout.left - 2 * gap - width, y, width, layout.dot);
        }
    }
    if (across.name.empty()) return;
    const std::int64_t y = layout.top + rows * (layout.tile_height + gap);
    for (std::size_t column = 0; column < across.values.size(); ++column) {
        const std::int64_t x =
            layout.left + static_cast<std::int64_t>(column) * (layout.tile_width + gap);
        draw_centred(map, across.values[column], x, layout.tile_width, y, layout.dot);
    }
    const auto columns = static_cast<std::int64_t>(across.values.size());
    draw_centred(map, across.name, layout.left,
                 std::max(columns * (layout.tile_width + gap) - gap,
                          text_width(across.name, layout.dot)),
                 y + line, layout.dot);
}

}  // namespace

Image make_map(std::span<const MapTile> tiles, const MapAxis& across, const MapAxis& up) {
    const std::size_t columns = across.values.size(), rows = up.values.size();
    CHECK(columns > 0 && rows > 0 && tiles.size() == columns * rows,
          "a map has a tile for every pair of values");
    const MapLayout layout = lay_out(tiles, across, up);
    Image map(layout.width, layout.height, sheet_ground);
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const auto column = static_cast<std::int64_t>(t % columns);
        const auto row = static_cast<std::int64_t>(rows - 1 - t / columns);
        draw_tile(map, tiles[t], layout, layout.left + column * (layout.tile_width + gap),
                  layout.top + row * (layout.tile_height + gap));
    }
    draw_axes(map, across, up, layout);
    return map;
}

}  // namespace cascade
