// Maps rows of a plane to the cells beside each side and back, and runs the side's kernel on those.
#include "solvers/changing_side.h"

#include <algorithm>
#include <array>

namespace cascade {

namespace {

/// The part of [begin, end) that lies in [first, last).
RowRange common(RowRange rows, std::int64_t first, std::int64_t last) {
    const std::int64_t begin = std::clamp(rows.begin, first, last);
    return {begin, std::max(begin, std::min(rows.end, last))};
}

/// The slices that have row number `row` among the given rows.
RowRange slices_with(RowRange rows, std::int64_t row, std::int64_t height) {
    const auto first_from = [&](std::int64_t bound) {
        return std::max<std::int64_t>(0, (bound - row + height - 1) / height);
    };
    return {first_from(rows.begin), first_from(rows.end)};
}

/// The values of some cells beside a side, padded; the padding may hold anything.
template <typename Number>
std::vector<Number> compute(const ChangingSide& side, SideMoment moment, SideCells cells) {
    std::vector<Number> uniforms(side.uniforms.begin(), side.uniforms.end());
    if (side.time_slot) uniforms[*side.time_slot] = static_cast<Number>(moment.t);
    if (side.step_slot) uniforms[*side.step_slot] = static_cast<Number>(moment.step);
    const std::int64_t padded = cells.count + PlaneLayout::row_pad;
    std::vector<std::vector<Number>> strips;
    std::vector<const Number*> fields;
    for (const std::vector<double>& strip : side.strips) {
        const auto first = strip.begin() + cells.first;
        strips.emplace_back(first, first + padded);
        fields.push_back(strips.back().data());
    }
    std::vector<Number> results(static_cast<std::size_t>(padded));
    const std::array<Number*, 1> result{results.data()};
    const Grid line{cells.count, 1};
    side.kernel->run(KernelArgumentsOf<Number>{fields, {}, uniforms, result, PlaneLayout(line)},
                     {0, 1});
    return results;
}

template <typename Number>
void set_values(const ChangingSide& side, SideMoment moment, const PlaneLayout& layout,
                RowRange rows, SideRules& rules) {
    const SideCells cells =
        side.values == nullptr ? SideCells{0, 1} : SideCells::of_rows(layout, side.side, rows);
    if (cells.count == 0) return;
    const std::vector<Number> results = compute<Number>(side, moment, cells);
    if (side.values == nullptr) {
        rules.at[static_cast<std::size_t>(side.side)].value = results[0];
        return;
    }
    auto* values = static_cast<Number*>(side.values);
    for (std::int64_t k = 0; k < cells.count; ++k) {
        values[SideCells::offset(layout, side.side, cells.first + k)] =
            results[static_cast<std::size_t>(k)];
    }
    fill_halo_from_rows(values, layout, SideRules(boundary_of(rules)), rows.begin, rows.end);
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
    }
    return layout.row_start((layout.depth - 1) * layout.height + line) + column;
}

void set_side_values(std::span<const ChangingSide> sides, std::size_t species, SideMoment moment,
                     const PlaneLayout& layout, RowRange rows, SideRules& rules) {
    for (const ChangingSide& side : sides) {
        if (side.species != species) continue;
        with_number(side.precision, [&](auto zero) {
            set_values<decltype(zero)>(side, moment, layout, rows, rules);
        });
    }
}

Boundaries boundary_of(const SideRules& rules) {
    const auto along = [&](Side side) {
        return rules[side].kind == SideKind::periodic ? Boundary::periodic : Boundary::no_flux;
    };
    return {along(Side::left), along(Side::top), along(Side::front)};
}

}  // namespace cascade
