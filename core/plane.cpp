// Fills halos and converts planes.
#include "core/plane.h"

#include "core/check.h"
#include "core/side_cells.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace cascade {
namespace {

/// The cell that determines the cell beyond a side: the first or the last of the `count` cells of
/// an axis.
std::int64_t source_of(const SideRule& rule, Side side, std::int64_t count) {
    const bool is_before = static_cast<int>(side) % 2 == 0;
    return is_before == (rule.kind == SideKind::periodic) ? count - 1 : 0;
}

template <typename Number>
Number beyond(const SideRule& rule, Number cell, Number value, Number spacing) {
    return rule.kind == SideKind::fixed ? 2 * value - cell : cell + spacing * value;
}

/// Fills the halo cells whose values come from given columns of given rows of a slice.
template <typename Number>
class HaloFill {
public:
    /// `has_rows` says whether the rows above and below each slice are filled, too.
    HaloFill(Number* origin, const PlaneLayout& layout, const SideRules& sides, ColumnRange columns,
             bool has_rows)
        : origin_(origin),
          layout_(layout),
          sides_(sides),
          spacing_(static_cast<Number>(sides.spacing)),
          columns_(columns.within(layout.width)),
          has_rows_(has_rows) {
        const std::int64_t cells[3] = {layout.width, layout.height, layout.depth};
        for (std::size_t side = 0; side < side_count; ++side) {
            sources_[side] = source_of(sides.at[side], static_cast<Side>(side), cells[side / 2]);
        }
        is_left_given_ = columns_.contains(source(Side::left));
        is_right_given_ = columns_.contains(source(Side::right));
    }

    /// Each halo row depends on one row of cells and is filled together with it.
    void from_rows(std::int64_t slice, std::int64_t begin, std::int64_t end) const {
        fill_columns(slice, begin, end);
        const auto is_given = [&](Side side) {
            return has_rows_ && is_held(side) && begin <= source(side) && source(side) < end;
        };
        if (is_given(Side::top)) fill_row(Side::top, {source(Side::top), slice}, {-1, slice});
        if (is_given(Side::bottom)) {
            fill_row(Side::bottom, {source(Side::bottom), slice}, {layout_.height, slice});
        }
        if (!layout_.has_halo_slices()) return;
        for (const Side side : {Side::front, Side::back}) {
            if (slice != source(side) || !is_held(side)) continue;
            const std::int64_t to = side == Side::front ? -1 : layout_.depth;
            for (std::int64_t j = begin; j < end; ++j) fill_row(side, {j, slice}, {j, to});
            if (is_given(Side::top)) fill_row(side, {-1, slice}, {-1, to});
            if (is_given(Side::bottom)) {
                fill_row(side, {layout_.height, slice}, {layout_.height, to});
            }
        }
    }

private:
    struct RowPlace {
        std::int64_t row, slice;
    };

    /// Whether the halo beyond a side is in memory. A part of a grid holds the halo of some sides
    /// only.
    bool is_held(Side side) const {
        if (layout_.has_halo_slices() && side < Side::front) return true;
        return static_cast<int>(side) % 2 == 0 ? layout_.has_first() : layout_.has_last();
    }

    /// The side's value e at a cell beside the side.
    static Number value_at(const SideRule& rule, std::int64_t cell) {
        return static_cast<Number>(rule.values ? rule.values->at(cell) : rule.value);
    }
    std::int64_t source(Side side) const { return sources_[static_cast<std::size_t>(side)]; }
    std::int64_t start(RowPlace place) const {
        return place.slice * layout_.slice_stride + place.row * layout_.stride;
    }

    void fill_columns(std::int64_t slice, std::int64_t begin, std::int64_t end) const {
        if (is_left_given_) fill_column(Side::left, -1, slice, begin, end);
        if (is_right_given_) fill_column(Side::right, layout_.width, slice, begin, end);
    }

    void fill_column(Side side, std::int64_t to, std::int64_t slice, std::int64_t begin,
                     std::int64_t end) const {
        const SideRule& rule = sides_[side];
        const std::int64_t from = source(side);
        Number* cells = origin_ + start({begin, slice});
        if (!rule.has_value()) {
            for (std::int64_t j = begin; j < end; ++j, cells += layout_.stride) {
                cells[to] = cells[from];
            }
            return;
        }
        for (std::int64_t j = begin; j < end; ++j, cells += layout_.stride) {
            const Number value = value_at(rule, slice * layout_.height + j);
            cells[to] = beyond(rule, cells[from], value, spacing_);
        }
    }

    /// The number of the first cell beside a side in a row. A halo row has the number of the
    /// nearest row of cells, because the side's values continue into the halo as the field's do.
    std::int64_t first_beside(Side side, RowPlace from) const {
        const std::int64_t of_slice = from.row < 0                 ? source(Side::top)
                                      : from.row >= layout_.height ? source(Side::bottom)
                                                                   : from.row;
        const std::int64_t row = from.slice * layout_.height + of_slice;
        return SideCells::of_rows(layout_, side, {row, row + 1}).first;
    }

    /// Fills the columns of a halo row beyond a side, and the halo columns that depend on them.
    void fill_row(Side side, RowPlace from, RowPlace to) const {
        const SideRule& rule = sides_[side];
        const Number* cells = origin_ + start(from);
        Number* halo = origin_ + start(to);
        // `set(i, column)` fills column i of the halo row with the side's value at `column`.
        const auto fill = [&](const auto& set) {
            if (is_left_given_) set(-1, source(Side::left));
            for (std::int64_t i = columns_.begin; i < columns_.end; ++i) set(i, i);
            if (is_right_given_) set(layout_.width, source(Side::right));
        };
        if (!rule.has_value()) {
            std::memcpy(halo + columns_.begin, cells + columns_.begin,
                        static_cast<std::size_t>(columns_.count()) * sizeof(Number));
            if (is_left_given_) halo[-1] = cells[-1];
            if (is_right_given_) halo[layout_.width] = cells[layout_.width];
        } else if (rule.values) {
            const std::int64_t first = first_beside(side, from);
            fill([&](std::int64_t i, std::int64_t column) {
                halo[i] = beyond(rule, cells[i], value_at(rule, first + column), spacing_);
            });
        } else {
            const auto value = static_cast<Number>(rule.value);
            fill([&](std::int64_t i, std::int64_t) {
                halo[i] = beyond(rule, cells[i], value, spacing_);
            });
        }
    }

    Number* origin_;
    const PlaneLayout& layout_;
    const SideRules& sides_;
    Number spacing_;
    ColumnRange columns_;
    bool has_rows_, is_left_given_ = false, is_right_given_ = false;
    std::array<std::int64_t, side_count> sources_{};
};

template <typename Number>
void fill_slices(const HaloFill<Number>& fill, const PlaneLayout& layout, RowRange rows) {
    CHECK(layout.rows.begin <= rows.begin && rows.end <= layout.rows.end,
          "a halo comes from rows of the plane");
    while (rows.begin < rows.end) {
        const std::int64_t slice = rows.begin / layout.height;
        const std::int64_t first = rows.begin - slice * layout.height;
        const std::int64_t last = std::min(layout.height, first + rows.end - rows.begin);
        fill.from_rows(slice, first, last);
        rows.begin += last - first;
    }
}

}  // namespace

Field Field::converted(Precision precision) const {
    if (precision == this->precision()) return clone();
    Field copy(layout(), precision);
    visit([&](const auto& from) {
        copy.visit([&](auto& to) {
            const auto* cells = from.origin() - layout().offset(0, 0);
            auto* target = to.origin() - layout().offset(0, 0);
            std::transform(cells, cells + layout().size(), target, [](auto cell) {
                return static_cast<std::remove_reference_t<decltype(*target)>>(cell);
            });
        });
    });
    return copy;
}

template <typename Number>
void fill_halo(Number* origin, const PlaneLayout& layout, const SideRules& sides) {
    fill_slices(HaloFill<Number>(origin, layout, sides, {}, true), layout, layout.rows);
}

template <typename Number>
void fill_halo_from(Number* origin, const PlaneLayout& layout, const SideRules& sides,
                    const Patch& patch) {
    fill_slices(HaloFill<Number>(origin, layout, sides, patch.columns, layout.height > 1), layout,
                patch.rows);
}

void Field::fill_halo(const SideRules& sides) const {
    visit([&](const auto& plane) { plane.fill_halo(sides); });
}

template void fill_halo<float>(float*, const PlaneLayout&, const SideRules&);
template void fill_halo<double>(double*, const PlaneLayout&, const SideRules&);
template void fill_halo_from<float>(float*, const PlaneLayout&, const SideRules&, const Patch&);
template void fill_halo_from<double>(double*, const PlaneLayout&, const SideRules&, const Patch&);

}  // namespace cascade
