// Counts pixels, and what is in memory while a picture is painted.
#include "run/pictures/picture_size.h"

#include "core/quantities.h"
#include "render/draw.h"

#include <fmt/format.h>

namespace cascade {

Result<void> check_picture_size(const DomainSettings& domain, const PictureRequest& picture,
                                double memory, std::uint64_t memory_limit) {
    constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
    Grid grid = domain.grid;
    // A picture of a surface has a size of its own.
    const bool is_drawn = domain.model || (domain.surface && !picture.flat);
    if (is_drawn) grid = Grid{DrawOptions().width, DrawOptions().height};
    else if (grid.depth > 1) grid = slice_grid(PlaneLayout(grid), picture.slice);
    const std::int64_t pixels_per_cell = std::int64_t{picture.scale} * picture.scale;
    const char* const hint = is_drawn ? "use a smaller --scale" : "use a smaller grid or --scale";
    if (grid.cell_count() > most_pixels / pixels_per_cell) {
        return failure(fmt::format("a picture of {} × {} {} at scale {} has more than {} pixels",
                                   grid.width, grid.height, is_drawn ? "pixels" : "cells",
                                   picture.scale, most_pixels),
                       hint);
    }
    // An enlarged picture is painted at one pixel per cell first.
    const std::int64_t pixels_of_cell = pixels_per_cell > 1 ? 1 + pixels_per_cell : 1;
    const auto pixels = static_cast<double>(grid.cell_count() * pixels_of_cell);
    const double bytes = memory + pixels * sizeof(Colour);
    if (memory_limit == 0 || bytes <= static_cast<double>(memory_limit)) return {};
    return failure(fmt::format("with a picture at scale {} this run needs {}, but {} are the limit "
                               "(--limit-memory)",
                               picture.scale, with_unit(bytes, "B"),
                               with_unit(static_cast<double>(memory_limit), "B")),
                   hint);
}

}  // namespace cascade
