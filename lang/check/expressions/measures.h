// The dimensions of formulas, and whether they are consistent (internal to the checker).
//
// A number or a name without a unit can have any dimension. So contradictions can be found only
// between parts of a formula that have a unit.
#pragma once

#include "lang/program/formula.h"
#include "lang/syntax/script_units.h"

#include <functional>
#include <string>
#include <vector>

namespace cascade::checking {

/// What is known about the dimension of a value.
struct Measure {
    enum class Kind : std::uint8_t {
        any,    ///< The value has no unit, so it can have any dimension.
        plain,  ///< The value is a plain number such as 1 or exp(u), without a unit in the script.
        known,
    };
    Kind kind = Kind::any;
    Dimension dimension = {};

    static Measure of(const Dimension& dimension) { return {Kind::known, dimension}; }
    bool is_known() const { return kind == Kind::known; }
};

/// Two parts of a formula whose dimensions contradict each other.
struct Contradiction {
    Span span;    ///< Where to report the contradiction.
    Span first;   ///< Where the part with the dimension `left` is.
    Span second;  ///< Where the part with the dimension `right` is; empty if there is no such part.
    Dimension left, right;
    std::string what = {};  ///< The name of the first part in messages, in place of its text.
};

/// The measures of the leaves of formulas.
struct MeasureOf {
    const ScriptUnits& units;
    const MeasuredSpans& measured;
    /// Returns the measure of an item, a definition, a rate or an item of another stage.
    std::function<Measure(const Node&)> name;
    /// The measure of a number without a unit. In starting values it is `plain`. In rates it is
    /// `any`, because the number may be a rate whose unit was left out.
    Measure::Kind number = Measure::Kind::any;
};

/// A dimension in words for messages: `in um^2/s`, `a plain number`.
std::string words_of_dimension(const ScriptUnits& units, const Dimension& dimension);

/// The measure of a formula. Adds contradictions to `found`.
Measure measure_of(const Formula& formula, const MeasureOf& leaves,
                   std::vector<Contradiction>& found);

}  // namespace cascade::checking
