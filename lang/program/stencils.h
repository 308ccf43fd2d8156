// The differences between neighbouring cells of which operators are made, as data: offsets and
// weights. What kernels compute and which cells they read (lang/lower) and bounds (lang/calculus)
// follow from one table, and tests hold the symbols of waves (analysis) to it. Spec/numerics.md has
// the same formulas.
#pragma once

#include "lang/program/program.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// A cell near another one: each offset is −1, 0 or 1.
struct Offset {
    int dx = 0, dy = 0, dz = 0;

    static constexpr std::uint32_t count = 27;
    static constexpr Offset of(std::uint32_t number) {
        const int n = static_cast<int>(number);
        return {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    }
    constexpr std::uint32_t number() const {
        return static_cast<std::uint32_t>(dx + 1 + 3 * (dy + 1) + 9 * (dz + 1));
    }
    /// One cell forwards or backwards along an axis (0, 1, 2).
    static constexpr Offset along(int axis, int by) {
        return {axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0};
    }
    constexpr Offset operator+(Offset other) const {
        return {dx + other.dx, dy + other.dy, dz + other.dz};
    }
    constexpr bool is_own() const { return dx == 0 && dy == 0 && dz == 0; }
    friend constexpr bool operator==(Offset, Offset) = default;
};

/// A set of offsets, by their numbers.
using Offsets = std::uint32_t;
constexpr Offsets only(Offset offset) { return Offsets{1} << offset.number(); }
inline constexpr Offsets own_cell = only(Offset{});

/// The axes of more than one cell: 0 is x, 1 is y, 2 is z.
struct GridAxes {
    std::vector<int> present;

    explicit GridAxes(const Stencil& stencil);
    bool has(int axis) const;
};

/// The differences of the table.
enum class Difference : std::uint8_t {
    laplacian,  ///< The sum of the second differences along all axes.
    second,
    central,
    across,     ///< From a cell to the next one, at the face between them.
    average,    ///< Of both, at the face.
    backward,   ///< Of a flow along the axis.
    forward,    ///< Of a flow against it.
    isotropic,  ///< The Laplacian with an error that favours no direction.
    mixed,      ///< Of two axes.
};
inline constexpr std::size_t difference_count = 9;

struct Tap {
    Offset at;
    int weight = 0;
};

/// Σ weight · e(at) / (divisor h^order).
struct Taps {
    std::vector<Tap> taps;  ///< In the order of the sum; empty along an axis that the grid lacks.
    int divisor = 1, order = 0;
    bool at_face = false;  ///< The value lies half a cell after the one at the offset 0.

    /// divisor h^order.
    double size(double spacing) const;
    Offsets offsets() const;
};
Taps taps_of(Difference difference, const GridAxes& axes, int first = 0, int second = 0);

/// How a stencil has a difference: base − h²/error · outer(inner). Without an error it is `base`.
struct StencilRow {
    StencilKind stencil;
    Difference of, base;
    double error = 0;
    Difference outer = {}, inner = {};
    /// The largest magnitude of its symbol on one, two and three axes, for a spacing of 1.
    std::array<double, 3> largest{};
};
StencilRow stencil_row(StencilKind stencil, Difference difference);

/// An operator that is one difference.
struct AppliedDifference {
    Difference difference;
    int first = 0, second = 0;
};
std::optional<AppliedDifference> difference_of(Function function);

/// The cell itself and its neighbours along all axes.
Offsets crosswise(const GridAxes& axes);
/// The offsets at which an operator reads its last operand, including those of the differences that
/// it multiplies by values of cells.
Offsets offsets_of(const Node& operation, const GridAxes& axes);

}  // namespace cascade
