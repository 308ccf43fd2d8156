// Counts pixels, and what is in memory while a picture is painted.
#include "run/pictures/picture_size.h"

#include "core/quantities.h"

#include <fmt/format.h>

namespace cascade {

namespace {

bool is_drawn(const DomainSettings& domain, const PictureRequest& picture) {
    return domain.model || (domain.surface && !picture.flat);
}

/// One pixel for each cell that is shown, or the default size of rendered pictures.
PictureSize unscaled_size(const DomainSettings& domain, const PictureRequest& picture,
                          bool is_drawn) {
    if (is_drawn) return picture.size;
    if (domain.grid.depth == 1) return {domain.grid.width, domain.grid.height};
    const Grid grid = slice_grid(PlaneLayout(domain.grid), picture.slice);
    return {grid.width, grid.height};
}

}  // namespace

PictureSize picture_size(const DomainSettings& domain, const PictureRequest& picture,
                         bool has_cells) {
    PictureSize size = unscaled_size(domain, picture, has_cells || is_drawn(domain, picture));
    size.width *= picture.scale;
    size.height *= picture.scale;
    return size;
}

Result<void> check_picture_size(const DomainSettings& domain, const PictureRequest& picture,
                                double memory, std::uint64_t memory_limit) {
    constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
    // Only what is drawn from a place in space has another size than the usual one.
    const bool is_scene = is_drawn(domain, picture) || picture.size != usual_size;
    const PictureSize size = unscaled_size(domain, picture, is_scene);
    const std::int64_t count = size.width * size.height;
    const std::int64_t pixels_per_cell = std::int64_t{picture.scale} * picture.scale;
    const char* const hint = !is_scene            ? "use a smaller grid or --scale"
                             : picture.scale == 1 ? "use a smaller --size"
                                                  : "use a smaller --size or --scale";
    if (count > most_pixels / pixels_per_cell) {
        const std::string scale =
            is_scene && picture.scale == 1 ? "" : fmt::format(" at scale {}", picture.scale);
        return failure(fmt::format("a picture of {} × {} {}{} has more than {} pixels", size.width,
                                   size.height, is_scene ? "pixels" : "cells", scale, most_pixels),
                       hint);
    }
    // An enlarged picture is painted at one pixel per cell first.
    const std::int64_t pixels_of_cell = pixels_per_cell > 1 ? 1 + pixels_per_cell : 1;
    const auto pixels = static_cast<double>(count * pixels_of_cell);
    const double bytes = memory + pixels * sizeof(Colour);
    if (memory_limit == 0 || bytes <= static_cast<double>(memory_limit)) return {};
    return failure(fmt::format("with a picture at scale {} this run needs {}, but {} are the limit "
                               "(--limit-memory)",
                               picture.scale, with_unit(bytes, "B"),
                               with_unit(static_cast<double>(memory_limit), "B")),
                   hint);
}

}  // namespace cascade
