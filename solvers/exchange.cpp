// Copies rows between the planes of parts.
#include "solvers/exchange.h"

#include "core/check.h"
#include "solvers/layers_in_memory.h"

#include <algorithm>
#include <cstring>

namespace cascade {
namespace {

/// Copies `rows` of a plane, with their halo columns, to the rows of `to` that begin at `first`.
void copy_rows(const Field& from, RowRange rows, Field& to, std::int64_t first) {
    if (rows.empty()) return;
    const std::span<const std::byte> source = memory_of(from, rows);
    std::memcpy(memory_of(to, {first, first + rows.count()}).data(), source.data(), source.size());
}

}  // namespace

std::int64_t rows_of_layer(const PlaneLayout& layout) {
    return layout.has_halo_slices() ? layout.height : 1;
}

RowRange held(const PlaneLayout& layout) {
    const std::int64_t halo = rows_of_layer(layout);
    return {layout.rows.begin - halo, layout.rows.end + halo};
}

std::span<const std::byte> memory_of(const Field& field, RowRange rows) {
    const PlaneLayout& layout = field.layout();
    const RowRange all = held(layout);
    CHECK(rows.begin >= all.begin && rows.end <= all.end, "a plane holds the rows to be copied");
    const std::int64_t stride = layout.has_halo_slices() ? layout.slice_stride : layout.stride;
    const std::int64_t halo_row = layout.has_halo_slices() ? layout.stride : 0;
    const std::int64_t before = layout.row_start(rows.begin) - halo_row - PlaneLayout::row_pad;
    const auto count = static_cast<std::size_t>(rows.count() / rows_of_layer(layout) * stride);
    return field.visit([&](const auto& plane) {
        return std::as_bytes(std::span(plane.origin() + before, count));
    });
}

std::span<std::byte> memory_of(Field& field, RowRange rows) {
    const std::span<const std::byte> memory = memory_of(std::as_const(field), rows);
    return {const_cast<std::byte*>(memory.data()), memory.size()};
}

std::vector<RowRange> cut_grid(const Grid& grid, int count) {
    const std::int64_t layer = rows_of_layer(PlaneLayout(grid));
    const std::int64_t layers = grid.height * grid.depth / layer;
    const int parts = static_cast<int>(std::clamp<std::int64_t>(count, 1, layers));
    std::vector<RowRange> all;
    for (int part = 0; part < parts; ++part) {
        const RowRange own = split_rows(layers, part, parts);
        all.push_back({own.begin * layer, own.end * layer});
    }
    return all;
}

RowRange with_neighbours(const Grid& grid, RowRange part, std::int64_t width, bool wraps) {
    const std::int64_t rows = width * rows_of_layer(PlaneLayout(grid));
    const RowRange all{part.begin - rows, part.end + rows};
    return wraps ? all : common(all, {0, grid.height * grid.depth});
}

void copy_held(const Field& from, Field& to) {
    const RowRange both = common(held(from.layout()), held(to.layout()));
    copy_rows(from, both, to, both.begin);
}

void copy_across(Field& whole) {
    const RowRange rows = whole.layout().rows;
    const std::int64_t layer = rows_of_layer(whole.layout());
    copy_rows(whole, {rows.end - layer, rows.end}, whole, rows.begin - layer);
    copy_rows(whole, {rows.begin, rows.begin + layer}, whole, rows.end);
}

void LocalExchange::fill_halos(std::span<const Shared> planes, std::int64_t width) {
    board_.shared[number_] = planes;
    board_.team.barrier();
    const std::int64_t all = grid_.height * grid_.depth;
    const std::int64_t layer = rows_of_layer(PlaneLayout(grid_));
    const auto fill = [&](std::size_t plane, std::int64_t first) {
        const Shared& own = planes[plane];
        if ((first < 0 || first >= all) && !own.wraps) return;
        const std::int64_t source = (first + all) % all;
        const auto owner = std::find_if(parts_.begin(), parts_.end(),
                                        [&](RowRange part) { return source < part.end; });
        const Shared& other =
            board_.shared[static_cast<std::size_t>(owner - parts_.begin())][plane];
        copy_rows(*other.field, {source, source + layer}, *own.field, first);
    };
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        for (std::int64_t distance = 0; distance < width; ++distance) {
            fill(plane, rows().begin - (distance + 1) * layer);
            fill(plane, rows().end + distance * layer);
        }
    }
    board_.team.barrier();
}

void LocalExchange::share_rows(std::span<std::vector<double>* const> rows) {
    board_.rows[number_] = rows;
    board_.team.barrier();
    for (std::size_t part = 0; part < count(); ++part) {
        if (part == number_) continue;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const std::vector<double>& from = *board_.rows[part][k];
            std::copy(from.begin() + parts_[part].begin, from.begin() + parts_[part].end,
                      rows[k]->begin() + parts_[part].begin);
        }
    }
    board_.team.barrier();
}

void LocalExchange::gather(std::span<const Field* const> own, std::span<Field* const> whole) {
    board_.fields[number_] = own;
    board_.team.barrier();
    for (std::size_t part = 0; is_root() && part < count(); ++part) {
        for (std::size_t k = 0; k < whole.size(); ++k) {
            const Field& from = *board_.fields[part][k];
            RowRange rows = parts_[part];
            if (part == 0) rows.begin = held(whole[k]->layout()).begin;
            if (part + 1 == count()) rows.end = held(whole[k]->layout()).end;
            copy_rows(from, rows, *whole[k], rows.begin);
        }
    }
    board_.team.barrier();
}

void LocalExchange::scatter(std::span<const Field* const> whole, std::span<Field* const> own) {
    if (is_root()) board_.fields[0] = whole;
    board_.team.barrier();
    for (std::size_t k = 0; k < own.size(); ++k) copy_held(*board_.fields[0][k], *own[k]);
    board_.team.barrier();
}

}  // namespace cascade
