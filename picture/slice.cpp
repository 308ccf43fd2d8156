// Copies cell by cell.
#include "picture/slice.h"

#include <algorithm>

namespace cascade {

namespace {

std::int64_t cells_along(const PlaneLayout& layout, Axis axis) {
    switch (axis) {
        case Axis::x: return layout.width;
        case Axis::y: return layout.height;
        case Axis::z: return layout.depth;
    }
    return 1;
}

}  // namespace

std::int64_t slice_number(const PlaneLayout& layout, Slice slice) {
    const std::int64_t cells = cells_along(layout, slice.axis);
    const auto number = static_cast<std::int64_t>(slice.place * static_cast<double>(cells));
    return std::clamp<std::int64_t>(number, 0, cells - 1);
}

Grid slice_grid(const PlaneLayout& layout, Slice slice) {
    switch (slice.axis) {
        case Axis::x: return Grid{layout.depth, layout.height};
        case Axis::y: return Grid{layout.width, layout.depth};
        case Axis::z: break;
    }
    return Grid{layout.width, layout.height};
}

Field cut(const Field& field, Slice slice) {
    const std::int64_t number = slice_number(field.layout(), slice);
    const Grid grid = slice_grid(field.layout(), slice);
    Field picture{PlaneLayout(grid)};
    for (std::int64_t row = 0; row < grid.height; ++row) {
        for (std::int64_t column = 0; column < grid.width; ++column) {
            picture.at(column, row) = slice.axis == Axis::x   ? field.at(number, row, column)
                                      : slice.axis == Axis::y ? field.at(column, number, row)
                                                              : field.at(column, row, number);
        }
    }
    return picture;
}

}  // namespace cascade
