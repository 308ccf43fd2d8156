// Copies values from the order in memory to the order in which files list the cells.
#include "run/pictures/cell_look.h"

#include "export/channels.h"

#include <algorithm>

namespace cascade {

CellLook::CellLook(const Canvas& canvas, ValueRange range, const Palette& palette,
                   const InOrder& in_order)
    : channels(canvas.fields.size()) {
    for (std::size_t c = 0; c < channels; ++c) {
        const std::vector<double> of_cells = in_order(canvas.fields[c]);
        values.resize(channels * of_cells.size());
        for (std::size_t k = 0; k < of_cells.size(); ++k) {
            values[channels * k + c] = static_cast<float>(of_cells[k]);
        }
    }
    if (canvas.is_colour()) {
        colour = [](std::span<const float> rgb, const SurfacePlace&) {
            const auto shown = [](float channel) { return std::clamp(channel, 0.0F, 1.0F); };
            return Colour{shown(rgb[0]), shown(rgb[1]), shown(rgb[2])};
        };
        colours = [](std::span<const float> rgb, std::span<Colour> painted) {
            for (std::size_t k = 0; k < painted.size(); ++k) {
                painted[k] = shown({rgb[3 * k], rgb[3 * k + 1], rgb[3 * k + 2]});
            }
        };
        return;
    }
    colour = [range, &palette](std::span<const float> value, const SurfacePlace&) {
        return colour_at(palette, position_in(range, value[0]));
    };
    colours = [range, &palette](std::span<const float> at, std::span<Colour> painted) {
        paint(at, range, palette, painted);
    };
}

}  // namespace cascade
