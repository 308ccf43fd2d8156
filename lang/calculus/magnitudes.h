// Bounds of the values of parts of rates. They are computed from bounds of the values that the
// rates read. They show which parts are too small or too large for single precision, and how much a
// formula changes because of these parts.
#pragma once

#include "core/side.h"
#include "lang/program/program.h"

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace cascade {

/// Bounds of the magnitude of a value in all cells.
struct Magnitude {
    double least = 0;
    double most = std::numeric_limits<double>::infinity();
    bool is_positive = false;  ///< No value is below 0.
    bool is_negative = false;  ///< No value is above 0.

    static Magnitude of(double value) {
        return {std::abs(value), std::abs(value), value >= 0, value <= 0};
    }
};

/// A part of a formula that single precision loses: the part's value is out of range although its
/// operands are in range, or the part is too small to be added.
struct LostPart {
    enum class Cause {
        too_small,  ///< The part is so small that it counts as 0.
        too_large,  ///< The part is so large that it may be infinite in some cell.
        /// The part is less than half a unit in the last place of the number to which it is added.
        swallowed,
    };
    ItemId species;            ///< The species of the rate, or of the rule at a side.
    std::optional<Side> side;  ///< The side of the rule. nullopt for a rate.
    SideKind kind{};           ///< The kind of the rule.
    Span span;                 ///< Where the part is in the script.
    Span other;                ///< Where the number that swallows the part is in the script.
    Formula part;
    double value = 0;  ///< A bound of the part's magnitude.
    double lost = 0;   ///< A bound of how much the formula loses by all parts that count as 0.
    double whole = 0;  ///< A bound of the formula without the terms of operators.
    Cause cause = Cause::too_small;
};

/// Searches the rates, and the rules of species at sides and borders. `magnitude_of` gives the
/// magnitudes of the items that they read. For each formula, returns the part by which the formula
/// loses most, and one part that may be too large.
std::vector<LostPart> find_lost_parts(const Program& program, std::uint32_t stage,
                                      const std::function<Magnitude(ItemId)>& magnitude_of);

}  // namespace cascade
