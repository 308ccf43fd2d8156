// Runs a side's kernel on the cells beside the side.
#include "solvers/changing_side.h"

#include "core/check.h"
#include "core/side_cells.h"

#include <array>
#include <memory>
#include <utility>

namespace cascade {

namespace {

/// A plane's values in some cells beside a side, padded with zeros.
template <typename Number>
std::vector<Number> strip_of(const Field* field, Side side, SideCells cells, std::int64_t padded) {
    CHECK(field != nullptr, "a side reads species that the same pass has written");
    const Plane<Number>& plane = field->plane<Number>();
    std::vector<Number> strip(static_cast<std::size_t>(padded));
    for (std::int64_t k = 0; k < cells.count; ++k) {
        strip[static_cast<std::size_t>(k)] =
            plane.origin()[SideCells::offset(plane.layout(), side, cells.first + k)];
    }
    return strip;
}

/// Computes the values at the side next to `cells`. The padding of the result is undefined.
template <typename Number>
std::vector<Number> compute(const ChangingSide& side, SideMoment moment,
                            const SpeciesPlanes& present, SideCells cells) {
    std::vector<Number> uniforms(side.uniforms.begin(), side.uniforms.end());
    if (side.time_slot) uniforms[*side.time_slot] = static_cast<Number>(moment.t);
    if (side.step_slot) uniforms[*side.step_slot] = static_cast<Number>(moment.step);
    const std::int64_t padded = cells.count + PlaneLayout::row_pad;
    std::vector<std::vector<Number>> strips;
    std::vector<const Number*> fields;
    for (std::size_t slot = 0; slot < side.strips.size(); ++slot) {
        if (const auto species = side.reads[slot]) {
            strips.push_back(strip_of<Number>(present[species->index()], side.side, cells, padded));
        } else {
            const auto first = side.strips[slot].begin() + cells.first;
            strips.emplace_back(first, first + padded);
        }
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
void set_values(const ChangingSide& side, SideMoment moment, const SpeciesPlanes& present,
                const PlaneLayout& layout, RowRange rows, SideRules& rules) {
    const SideCells cells =
        side.varies ? SideCells::of_rows(layout, side.side, rows) : SideCells{0, 1};
    if (cells.count == 0) return;
    const std::vector<Number> results = compute<Number>(side, moment, present, cells);
    SideRule& rule = rules.at[static_cast<std::size_t>(side.side)];
    if (side.varies) {
        SideValues values{cells.first, {results.begin(), results.begin() + cells.count}};
        rule.values = std::make_shared<const SideValues>(std::move(values));
    } else {
        rule.value = results[0];
    }
}

}  // namespace

SpeciesPlanes planes_of(std::span<const Field> species) {
    SpeciesPlanes planes;
    for (const Field& field : species) planes.push_back(&field);
    return planes;
}

void set_side_values(std::span<const ChangingSide> sides, SpeciesId species, SideMoment moment,
                     const SpeciesPlanes& present, const PlaneLayout& layout, const Patch& cells,
                     SideRules& rules) {
    const auto is_beside = [&](Side side) {
        if (side == Side::left) return cells.columns.contains(0);
        return side != Side::right || cells.columns.contains(layout.width - 1);
    };
    for (const ChangingSide& side : sides) {
        if (side.species != species || !is_beside(side.side)) continue;
        with_number(side.precision, [&](auto zero) {
            set_values<decltype(zero)>(side, moment, present, layout, cells.rows, rules);
        });
    }
}

}  // namespace cascade
