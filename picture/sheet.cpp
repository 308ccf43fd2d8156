// Draws contact sheets: several pictures side by side, each with a label below it.
#include "core/check.h"
#include "picture/image.h"
#include "picture/lettering.h"

#include <algorithm>
#include <cstddef>

namespace cascade {
namespace {

constexpr std::int64_t comfortable_panel = 192;  // Pictures smaller than half of this are enlarged.
// Pixels between the frame of a picture and its label.
constexpr std::int64_t label_gap = 6;

/// Sizes in pixels that all panels of a sheet share.
struct Sizes {
    std::int64_t enlarge = 1;  ///< The factor for all pictures.
    std::int64_t width = 0;    ///< The width of the widest picture after enlarging.
    std::int64_t height = 0;   ///< The height of the highest picture after enlarging.
    std::int64_t dot = 1;      ///< The width of a dot of the font.
};

std::int64_t shown_height(const Image& image, std::int64_t factor) {
    return std::max(image.height * factor, least_band_height);
}

Sizes sizes_of(std::span<const Panel> panels) {
    std::int64_t longest = 1;
    for (const Panel& panel : panels) {
        longest = std::max({longest, panel.image.width, panel.image.height});
    }
    Sizes sizes;
    sizes.enlarge = std::max<std::int64_t>(1, comfortable_panel / longest);
    for (const Panel& panel : panels) {
        sizes.width = std::max(sizes.width, panel.image.width * sizes.enlarge);
        sizes.height = std::max(sizes.height, shown_height(panel.image, sizes.enlarge));
    }
    sizes.width = std::max(sizes.width, comfortable_panel / 2);
    sizes.dot = std::clamp<std::int64_t>(sizes.width / 96, 1, 3);
    return sizes;
}

}  // namespace

Image make_sheet(std::span<const Panel> panels, int columns) {
    CHECK(!panels.empty() && columns >= 1, "a sheet has panels and columns");
    const auto count = static_cast<std::int64_t>(panels.size());
    const std::int64_t across = std::min<std::int64_t>(columns, count);
    const std::int64_t down = (count + across - 1) / across;
    const Sizes sizes = sizes_of(panels);
    const std::int64_t panel_width = sizes.width + sheet_margin;
    const std::int64_t label_height = label_gap + text_height(sizes.dot);
    const std::int64_t panel_height = sizes.height + label_height + sheet_margin;
    Image sheet(across * panel_width + sheet_margin, down * panel_height + sheet_margin,
                sheet_ground);
    for (std::int64_t k = 0; k < count; ++k) {
        const Panel& panel = panels[static_cast<std::size_t>(k)];
        const std::int64_t x = sheet_margin + k % across * panel_width;
        const std::int64_t y = sheet_margin + k / across * panel_height;
        const std::int64_t height = shown_height(panel.image, sizes.enlarge);
        draw_framed(sheet, panel.image, x, y, sizes.enlarge, height);
        // The label is directly below its picture, even if other pictures in the row are higher.
        draw_text(sheet, panel.label, x, y + height + label_gap, sizes.width, sizes.dot);
    }
    return sheet;
}

}  // namespace cascade
