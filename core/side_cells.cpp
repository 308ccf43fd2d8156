// Maps rows of a plane to the cells beside each side and back.
#include "core/side_cells.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {
namespace {

/// The part of `rows` that lies in [first, last).
RowRange common(RowRange rows, std::int64_t first, std::int64_t last) {
    const std::int64_t begin = std::clamp(rows.begin, first, last);
    return {begin, std::max(begin, std::min(rows.end, last))};
}

/// The slices in which row `row`, counted within the slice, is one of the given rows.
RowRange slices_with(RowRange rows, std::int64_t row, std::int64_t height) {
    const auto first_from = [&](std::int64_t bound) {
        return std::max<std::int64_t>(0, (bound - row + height - 1) / height);
    };
    return {first_from(rows.begin), first_from(rows.end)};
}

}  // namespace

SideCells SideCells::of_rows(const PlaneLayout& layout, Side side, RowRange rows) {
    const std::int64_t height = layout.height, last_slice = (layout.depth - 1) * height;
    const auto times_width = [&](RowRange some, std::int64_t from) {
        return SideCells{(some.begin - from) * layout.width,
                         (some.end - some.begin) * layout.width};
    };
    switch (side) {
        case Side::left:
        case Side::right: return {rows.begin, rows.end - rows.begin};
        case Side::top: return times_width(slices_with(rows, 0, height), 0);
        case Side::bottom: return times_width(slices_with(rows, height - 1, height), 0);
        case Side::front: return times_width(common(rows, 0, height), 0);
        case Side::back: break;
        case Side::border: CHECK(false, "no cells lie beside the border of a mask alone");
    }
    return times_width(common(rows, last_slice, last_slice + height), last_slice);
}

std::int64_t SideCells::offset(const PlaneLayout& layout, Side side, std::int64_t number) {
    const std::int64_t line = number / layout.width, column = number % layout.width;
    switch (side) {
        case Side::left: return layout.row_start(number);
        case Side::right: return layout.row_start(number) + layout.width - 1;
        case Side::top: return layout.row_start(line * layout.height) + column;
        case Side::bottom:
            return layout.row_start(line * layout.height + layout.height - 1) + column;
        case Side::front: return layout.row_start(line) + column;
        case Side::back: break;
        case Side::border: CHECK(false, "no cells lie beside the border of a mask alone");
    }
    return layout.row_start((layout.depth - 1) * layout.height + line) + column;
}

std::vector<double> values_beside(const Field& field, Side side) {
    const PlaneLayout& layout = field.layout();
    const SideCells all = SideCells::of_rows(layout, side, {0, layout.row_count()});
    std::vector<double> values;
    field.visit([&](const auto& plane) {
        for (std::int64_t cell = 0; cell < all.count; ++cell) {
            values.push_back(plane.origin()[SideCells::offset(layout, side, cell)]);
        }
    });
    return values;
}

}  // namespace cascade
