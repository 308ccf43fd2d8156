// The sides of a grid and what a field is there.
#pragma once

#include "core/grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cascade {

/// The sides in order of the axes: those before the first cells and those after the last.
enum class Side : std::uint8_t { left, right, top, bottom, front, back };

inline constexpr std::size_t side_count = 6;
inline constexpr std::array<std::string_view, side_count> side_names{"left",   "right", "top",
                                                                     "bottom", "front", "back"};

/// The side at the other end of the axis.
constexpr Side opposite(Side side) {
    return static_cast<Side>(static_cast<std::uint8_t>(side) ^ 1u);
}

/// What a cell at a side sees beyond it, c being its own value, e the side's and h the spacing.
enum class SideKind : std::uint8_t {
    periodic,  ///< The cell of the opposite side.
    no_flux,   ///< c: nothing flows through the side.
    fixed,     ///< 2e − c: the value at the face is e.
    flux,      ///< c + h·e: the derivative along the outward normal is e.
};

constexpr bool takes_value(SideKind kind) {
    return kind == SideKind::fixed || kind == SideKind::flux;
}

/// How scripts write them.
inline constexpr std::array<std::string_view, 4> side_kind_words{"periodic", "noflux", "fixed",
                                                                 "flux"};

/// A side of one field. `values`, where it is set, points to cell (0, 0, 0) of a plane whose cells
/// beside the side hold e (its halo is filled), numbers of the field's precision; elsewhere e is
/// `value` everywhere.
struct SideRule {
    SideKind kind = SideKind::periodic;
    double value = 0;
    const void* values = nullptr;

    bool has_value() const { return takes_value(kind); }
};

/// All sides of one field.
struct SideRules {
    std::array<SideRule, side_count> at{};
    double spacing = 1;

    SideRules() = default;
    SideRules(const Boundaries& boundary) {  // NOLINT: boundaries are rules.
        const std::array<Boundary, 3> along{boundary.x, boundary.y, boundary.z};
        for (std::size_t side = 0; side < side_count; ++side) {
            at[side].kind =
                along[side / 2] == Boundary::periodic ? SideKind::periodic : SideKind::no_flux;
        }
    }
    const SideRule& operator[](Side side) const { return at[static_cast<std::size_t>(side)]; }
};

}  // namespace cascade
