// Counts the pixels of a picture, and the memory that painting it needs.
#include "run/pictures/picture_size.h"

#include "core/quantities.h"
#include "lang/syntax/picture_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

PictureSize cells_of(const Grid& grid, const Slice& slice) {
    if (grid.depth == 1) return {grid.width, grid.height};
    const Grid shown = slice_grid(PlaneLayout(grid), slice);
    return {shown.width, shown.height};
}

/// Returns the size of a copy before multiplication by `scale`: a pixel for each cell or, if a size
/// is requested, the largest size with which all copies fit into it.
PictureSize unscaled_copy(const Grid& grid, const PictureRequest& picture) {
    const PictureSize cells = cells_of(grid, picture.slice);
    if (!picture.size) return cells;
    const auto side = [](std::int64_t count) { return static_cast<double>(count); };
    const double room_across = side(picture.size->width) / picture.copies.across;
    const double room_down = side(picture.size->height) / picture.copies.down;
    const double pixels = std::min(room_across / side(cells.width), room_down / side(cells.height));
    const auto fitting = [&](std::int64_t count, double room) {
        const double rounded = std::round(side(count) * pixels);
        return static_cast<std::int64_t>(
            std::max(1.0, rounded > room ? std::floor(room) : rounded));
    };
    return {fitting(cells.width, room_across), fitting(cells.height, room_down)};
}

PictureSize unscaled_size(const Script& script, const PictureRequest& picture) {
    if (draws_scene(script, picture)) return picture.size.value_or(usual_size);
    const PictureSize copy = unscaled_copy(script.program->domain.grid, picture);
    return {copy.width * picture.copies.across, copy.height * picture.copies.down};
}

PictureSize scaled(PictureSize size, int scale) {
    return {size.width * scale, size.height * scale};
}

}  // namespace

bool has_cells(const Script& script) {
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        if (script.program->system_of(k).cells) return true;
    }
    return false;
}

bool draws_body(const Script& script, const PictureRequest& request) {
    const DomainSettings& domain = script.program->domain;
    return domain.grid.depth > 1 && !domain.model && !request.flat && request.slice == Slice() &&
           picture_expression(script.tree, "body");
}

bool draws_scene(const Script& script, const PictureRequest& picture) {
    const DomainSettings& domain = script.program->domain;
    return domain.model || (domain.surface && !picture.flat) || has_cells(script) ||
           draws_body(script, picture);
}

std::array<bool, 2> sides_that_repeat(const Grid& grid, const Slice& slice) {
    const Boundaries& sides = grid.boundary;
    const bool is_slice = grid.depth > 1;
    const Boundary columns = is_slice && slice.axis == Axis::x ? sides.z : sides.x;
    const Boundary rows = is_slice && slice.axis == Axis::y ? sides.z : sides.y;
    return {columns == Boundary::periodic, rows == Boundary::periodic};
}

PictureSize copy_size(const Grid& grid, const PictureRequest& picture) {
    return scaled(unscaled_copy(grid, picture), picture.scale);
}

PictureSize picture_size(const Script& script, const PictureRequest& picture) {
    return scaled(unscaled_size(script, picture), picture.scale);
}

Result<void> check_picture_size(const Script& script, const PictureRequest& picture, double memory,
                                std::uint64_t memory_limit) {
    constexpr std::int64_t most_picture_pixels = std::int64_t{1} << 28;
    const bool has_pixels = draws_scene(script, picture) || picture.size;
    const PictureSize size = unscaled_size(script, picture);
    const std::int64_t count = size.width * size.height;
    const std::int64_t pixels_per_cell = std::int64_t{picture.scale} * picture.scale;
    const char* const hint = !has_pixels          ? "use a smaller grid or --scale"
                             : picture.scale == 1 ? "use a smaller --size"
                                                  : "use a smaller --size or --scale";
    if (count > most_picture_pixels / pixels_per_cell) {
        const std::string scale =
            has_pixels && picture.scale == 1 ? "" : fmt::format(" at scale {}", picture.scale);
        return failure(fmt::format("a picture of {} × {} {}{} has more than {} pixels", size.width,
                                   size.height, has_pixels ? "pixels" : "cells", scale,
                                   most_picture_pixels),
                       hint);
    }
    // An enlarged picture is first painted with one pixel for each cell, which needs memory in
    // addition.
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
