// The table of differences, and functions that use it.
#include "lang/program/stencils.h"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>

namespace cascade {

namespace {

/// A difference along one axis or two axes.
struct DifferenceRow {
    struct Place {
        int first, second, weight;
    };
    Difference difference;
    std::array<Place, 4> places;  ///< Places with weight 0 are not used.
    int divisor, order;
    bool at_face = false;
};
constexpr std::array difference_rows = [] {
    using enum Difference;
    return std::array{
        DifferenceRow{second, {{{1, 0, 1}, {-1, 0, 1}, {0, 0, -2}}}, 1, 2},
        DifferenceRow{central, {{{1, 0, 1}, {-1, 0, -1}}}, 2, 1},
        DifferenceRow{across, {{{1, 0, 1}, {0, 0, -1}}}, 1, 1, true},
        DifferenceRow{average, {{{0, 0, 1}, {1, 0, 1}}}, 2, 0, true},
        DifferenceRow{backward, {{{0, 0, 1}, {-1, 0, -1}}}, 1, 1},
        DifferenceRow{forward, {{{1, 0, 1}, {0, 0, -1}}}, 1, 1},
        DifferenceRow{mixed, {{{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}}}, 4, 2},
    };
}();

/// A difference over all axes. weights[n − 1] is for grids with n axes, and contains the weight of
/// each neighbour along an axis, of each diagonal neighbour, and of the cell itself. The isotropic
/// Laplacian comes from Patra & Karttunen (2006).
struct Star {
    Difference difference;
    std::array<std::array<int, 3>, 3> weights;
    int divisor;
};
constexpr std::array stars = [] {
    using enum Difference;
    return std::array{
        Star{laplacian, {{{1, 0, -2}, {1, 0, -4}, {1, 0, -6}}}, 1},
        Star{isotropic, {{{6, 0, -12}, {4, 1, -20}, {2, 1, -24}}}, 6},
    };
}();
static_assert(difference_rows.size() + stars.size() == difference_count,
              "every difference has a row");

// Bounds of the symbols, with X = 4 sin²(θ/2) for each axis. On n axes the sum of X is at most 4 n,
// and the sum of X + X²/12 is at most 16/3 n. The sum of X minus the sum of XY/6 over pairs of axes
// is at most 16/3, and reaches this bound if X is 4 along two axes. sin θ is at most 1, and sin θ
// (1 + 2/3 sin²(θ/2)) is at most 1.3723.
// clang-format off
constexpr std::array stencil_rows = [] {
    using enum Difference;
    return std::array{
    StencilRow{StencilKind::cross, laplacian, laplacian, 0, {}, {}, {4, 8, 12}},
    StencilRow{StencilKind::cross, second, second, 0, {}, {}, {4, 4, 4}},
    StencilRow{StencilKind::cross, central, central, 0, {}, {}, {1, 1, 1}},
    StencilRow{StencilKind::isotropic, laplacian, isotropic, 0, {}, {}, {4, 16.0 / 3, 16.0 / 3}},
    StencilRow{StencilKind::fourth, laplacian, isotropic, 12, laplacian, laplacian, {16.0 / 3, 32.0 / 3, 16}},
    StencilRow{StencilKind::fourth, second, second, 12, second, second, {16.0 / 3, 16.0 / 3, 16.0 / 3}},
    StencilRow{StencilKind::fourth, central, central, 6, central, second, {11.0 / 8, 11.0 / 8, 11.0 / 8}},
    };
}();
// clang-format on

constexpr std::array<Offset, 6> neighbours{
    {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0, 0, 1}}};

int steps(Offset at) { return std::abs(at.dx) + std::abs(at.dy) + std::abs(at.dz); }

std::vector<Tap> taps_of(const Star& star, const GridAxes& axes) {
    std::vector<Tap> taps;
    if (axes.present.empty()) return taps;
    const auto [beside, across, own] = star.weights[axes.present.size() - 1];
    const auto add = [&](Offset at, int weight) {
        const bool exists = (at.dx == 0 || axes.has(0)) && (at.dy == 0 || axes.has(1)) &&
                            (at.dz == 0 || axes.has(2));
        if (exists && weight != 0) taps.push_back({at, weight});
    };
    for (const Offset at : neighbours) add(at, beside);
    for (std::uint32_t number = 0; number < Offset::count; ++number) {
        if (steps(Offset::of(number)) == 2) add(Offset::of(number), across);
    }
    add({}, own);
    return taps;
}

}  // namespace

GridAxes::GridAxes(const Stencil& stencil) {
    if (stencil.x) present.push_back(0);
    if (stencil.y) present.push_back(1);
    if (stencil.z) present.push_back(2);
}

bool GridAxes::has(int axis) const { return std::ranges::find(present, axis) != present.end(); }

double Taps::size(double spacing) const {
    double size = divisor;
    for (int k = 0; k < order; ++k) size *= spacing;
    return size;
}

Offsets Taps::offsets() const {
    Offsets all = 0;
    for (const Tap& tap : taps) all |= only(tap.at);
    return all;
}

Taps taps_of(Difference difference, const GridAxes& axes, int first, int second) {
    const auto star = std::ranges::find(stars, difference, &Star::difference);
    if (star != stars.end()) return {taps_of(*star, axes), star->divisor, 2};
    const DifferenceRow& row =
        *std::ranges::find(difference_rows, difference, &DifferenceRow::difference);
    Taps taps{{}, row.divisor, row.order, row.at_face};
    if (!axes.has(first) || (difference == Difference::mixed && !axes.has(second))) return taps;
    for (const auto& [along, across, weight] : row.places) {
        const Offset at = Offset::along(first, along) + Offset::along(second, across);
        if (weight != 0) taps.taps.push_back({at, weight});
    }
    return taps;
}

StencilRow stencil_row(StencilKind stencil, Difference difference) {
    for (const StencilKind kind : {stencil, StencilKind::cross}) {
        for (const StencilRow& row : stencil_rows) {
            if (row.stencil == kind && row.of == difference) return row;
        }
    }
    return {StencilKind::cross, difference, difference};
}

std::optional<AppliedDifference> difference_of(Function function) {
    if (function == Function::lap) return AppliedDifference{Difference::laplacian};
    if (function == Function::isotropic) return AppliedDifference{Difference::isotropic};
    const Derivative of = derivative_of(function);
    if (of.order == 0) return std::nullopt;
    if (of.is_mixed()) return AppliedDifference{Difference::mixed, of.first, of.second};
    return AppliedDifference{of.order == 1 ? Difference::central : Difference::second, of.first};
}

Offsets crosswise(const GridAxes& axes) {
    return own_cell | taps_of(Difference::laplacian, axes).offsets();
}

Offsets offsets_of(const Node& operation, const GridAxes& axes) {
    const auto read = [&](Difference difference, int first = 0, int second = 0) {
        return taps_of(difference, axes, first, second).offsets();
    };
    if (const auto own = difference_of(operation.function)) {
        return read(own->difference, own->first, own->second);
    }
    if (operation.calls(Function::limited) || operation.calls(Function::upwind)) {
        return read(Difference::second, operation.as<Call>()->detail);
    }
    if (operation.calls(Function::beside)) return only(Offset::of(operation.as<Call>()->detail));
    if (!operation.calls(Function::diffuse)) return crosswise(axes);
    return own_cell | read(Difference::second, 0) | read(Difference::second, 1) |
           read(Difference::mixed, 0, 1);
}

}  // namespace cascade
