// Bounds of the values of parts of rates, computed from bounds of the values that the rates read.
// The bounds show which parts are too small or too large for single precision, and by how much this
// changes a formula.
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

/// A part of a formula that single precision loses: its value is outside the range, although its
/// operands are inside, or it is too small to be added.
struct LostPart {
    enum class Cause {
        too_small,  ///< The part counts as 0.
        too_large,  ///< The part may be infinite in some cell.
        swallowed,  ///< Less than half of the last digit of the number to which the part is added.
    };
    ItemId species;            ///< The species of the rate, or of the rule at a side.
    std::optional<Side> side;  ///< The side of the rule. Empty for a rate.
    SideKind kind{};           ///< The kind of the rule.
    Span span;                 ///< Where the part is written.
    Span other;                ///< Where the number that swallows it is written.
    Formula part;
    double value = 0;  ///< A bound of the part's magnitude.
    double lost = 0;   ///< The formula's loss by all parts that count as 0.
    double whole = 0;  ///< A bound of the formula without the terms of operators.
    Cause cause = Cause::too_small;
};

/// Searches the rates, and the rules of species at sides and borders. `magnitude_of` gives the
/// magnitudes of the items that they read. Returns for each formula the part by which it loses
/// most, and one part that may be too large.
std::vector<LostPart> find_lost_parts(const Program& program, std::uint32_t stage,
                                      const std::function<Magnitude(ItemId)>& magnitude_of);

}  // namespace cascade
