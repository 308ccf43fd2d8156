// The sides of a grid, the border of a mask, and the boundary conditions of a field there.
#pragma once

#include "core/grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace cascade {

/// The sides of the grid, two per axis: before the first and after the last cells. `border` is the
/// border of a mask, which runs between cells of the grid.
enum class Side : std::uint8_t { left, right, top, bottom, front, back, border };

inline constexpr std::size_t side_count = 6;  ///< The sides of the grid.
/// The sides of the grid and the border.
inline constexpr std::size_t wall_count = side_count + 1;
inline constexpr std::array<std::string_view, wall_count> side_names{"left",   "right", "top",
                                                                     "bottom", "front", "back",
                                                                     "border"};

/// The side of the grid at the other end of the axis.
constexpr Side opposite(Side side) {
    return static_cast<Side>(static_cast<std::uint8_t>(side) ^ 1u);
}

/// A rule that gives the value beyond a side from the cell at the side. c is the value of this
/// cell, e the value given for the side, and h the spacing.
enum class SideKind : std::uint8_t {
    periodic,  ///< The cell at the opposite side.
    no_flux,   ///< c: nothing flows through the side.
    fixed,     ///< 2e − c: the value at the face is e.
    slope,     ///< c + h·e: the derivative along the outward normal is e.
    /// The flux e enters by diffusion. Occurs only in scripts: halos are filled by the equivalent
    /// slope (lang/calculus/side_values.h).
    flux,
};

constexpr bool takes_value(SideKind kind) {
    return kind == SideKind::fixed || kind == SideKind::slope || kind == SideKind::flux;
}

/// The words for the kinds in scripts, indexed by SideKind.
inline constexpr std::array<std::string_view, 5> side_kind_words{"periodic", "noflux", "fixed",
                                                                 "slope", "flux"};

/// Values e that vary along a side, in the field's precision. core/side_cells.h numbers the cells
/// beside a side.
struct SideValues {
    std::int64_t first = 0;  ///< The number of the cell that has the first value.
    /// One value for each cell beside the side from which the field's plane fills a halo cell.
    std::vector<double> numbers;

    double at(std::int64_t cell) const { return numbers[static_cast<std::size_t>(cell - first)]; }
};

/// The boundary condition of one field at one side. If `values` is null, e is `value` everywhere.
struct SideRule {
    SideKind kind = SideKind::periodic;
    double value = 0;
    std::shared_ptr<const SideValues> values;

    bool has_value() const { return takes_value(kind); }
};

/// The boundary conditions of one field at all sides.
struct SideRules {
    std::array<SideRule, side_count> at{};
    double spacing = 1;

    SideRules() = default;
    SideRules(const Boundaries& boundary) {  // NOLINT: implicit, because boundaries are rules.
        const std::array<Boundary, 3> along{boundary.x, boundary.y, boundary.z};
        for (std::size_t side = 0; side < side_count; ++side) {
            at[side].kind =
                along[side / 2] == Boundary::periodic ? SideKind::periodic : SideKind::no_flux;
        }
    }
    const SideRule& operator[](Side side) const { return at[static_cast<std::size_t>(side)]; }
};

}  // namespace cascade
