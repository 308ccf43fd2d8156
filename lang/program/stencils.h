// Operators are made from differences between neighbouring cells. A table contains the offsets and
// weights of these differences. Lowering makes kernels from the table (lang/lower), calculus
// computes bounds from it (lang/calculus), and tests compare it with the symbols of waves
// (analysis). spec/numerics.md has the same formulas.
#pragma once

#include "lang/program/program.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The largest distance, in cells along an axis, at which shifted(e, i, j) may read.
inline constexpr int farthest_shift = 8;

/// The position of a cell relative to another cell. Each offset is −1, 0 or 1.
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
    /// The offset of one cell along an axis (0, 1, 2): forwards if `by` is 1, backwards if `by` is
    /// −1.
    static constexpr Offset along(int axis, int by) {
        return {axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0};
    }
    constexpr Offset operator+(Offset other) const {
        return {dx + other.dx, dy + other.dy, dz + other.dz};
    }
    constexpr bool is_own() const { return dx == 0 && dy == 0 && dz == 0; }
    friend constexpr bool operator==(Offset, Offset) = default;
};

/// A set of offsets. Bit n says whether the offset with number n is in the set.
using Offsets = std::uint32_t;
constexpr Offsets only(Offset offset) { return Offsets{1} << offset.number(); }
inline constexpr Offsets own_cell = only(Offset{});

/// The axes along which the grid has more than one cell: 0 is x, 1 is y, 2 is z.
struct GridAxes {
    std::vector<int> present;

    explicit GridAxes(const Stencil& stencil);
    bool has(int axis) const;
};

/// The differences in the table.
enum class Difference : std::uint8_t {
    laplacian,  ///< The sum of the second differences along all axes.
    second,
    central,
    /// The difference from a cell to the next cell. The value belongs to the face between them.
    across,
    average,  ///< The mean of a cell and the next cell. The value belongs to the face between them.
    backward,   ///< The difference from the previous cell, for a flow along the axis.
    forward,    ///< The difference to the next cell, for a flow against the axis.
    isotropic,  ///< The Laplacian whose error is equal in all directions.
    mixed,      ///< The derivative along two different axes.
};
inline constexpr std::size_t difference_count = 9;

struct Tap {
    Offset at;
    int weight = 0;
};

/// The terms of a difference of e: Σ weight · e(at) / (divisor h^order), where h is the spacing.
struct Taps {
    /// The terms in the order in which they are added. Empty if the grid has only one cell along
    /// the axis.
    std::vector<Tap> taps;
    int divisor = 1, order = 0;
    /// Whether the value belongs to the face between the cell and the next cell.
    bool at_face = false;

    /// The value of divisor · h^order, where h is the spacing.
    double size(double spacing) const;
    Offsets offsets() const;
};
Taps taps_of(Difference difference, const GridAxes& axes, int first = 0, int second = 0);

/// The formula by which a stencil computes the difference `of`. With the spacing h, this is base −
/// h²/error · outer(inner), or only `base` if `error` is 0.
struct StencilRow {
    StencilKind stencil;
    Difference of, base;
    double error = 0;
    Difference outer = {}, inner = {};
    /// The largest magnitude of the difference's symbol on grids with one, two and three axes, for
    /// spacing 1.
    std::array<double, 3> largest{};
};
StencilRow stencil_row(StencilKind stencil, Difference difference);

/// An operator that is a single difference, with its axes.
struct AppliedDifference {
    Difference difference;
    int first = 0, second = 0;
};
std::optional<AppliedDifference> difference_of(Function function);

/// The cell itself and its neighbours along all axes.
Offsets crosswise(const GridAxes& axes);
/// The offsets at which an operator reads its last operand, including the offsets of differences
/// that the operator multiplies by values of cells.
Offsets offsets_of(const Node& operation, const GridAxes& axes);

}  // namespace cascade
