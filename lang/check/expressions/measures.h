// The dimensions of formulas, and whether they are consistent (internal to the checker).
//
// A number or a name without a unit fits every dimension. So a formula is checked only where
// everything in it has a unit.
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
        any,    ///< It has no unit, so it fits every dimension.
        plain,  ///< A plain number such as 1 or exp(u), whose unit was not written.
        known,
    };
    Kind kind = Kind::any;
    Dimension dimension = {};

    static Measure of(const Dimension& dimension) { return {Kind::known, dimension}; }
    bool is_known() const { return kind == Kind::known; }
};

/// Two parts of a formula whose dimensions contradict each other.
struct Contradiction {
    Span span;    ///< Where to report it.
    Span first;   ///< The part whose dimension is `left`.
    Span second;  ///< The part whose dimension is `right`; empty if there is no such part.
    Dimension left, right;
    std::string what = {};  ///< The name of the first part in messages, in place of its text.
};

/// The measures of the leaves of formulas.
struct MeasureOf {
    const ScriptUnits& units;
    const MeasuredSpans& measured;
    /// Of an item, a definition, a rate or an item of another stage.
    std::function<Measure(const Node&)> name;
    /// Of a number without a unit. In starting values it is a plain number; in rates it may be a
    /// rate whose unit was left out.
    Measure::Kind number = Measure::Kind::any;
};

/// A dimension for messages: `in um^2/s`, `a plain number`.
std::string words_of_dimension(const ScriptUnits& units, const Dimension& dimension);

/// The measure of a formula. Adds contradictions to `found`.
Measure measure_of(const Formula& formula, const MeasureOf& leaves,
                   std::vector<Contradiction>& found);

}  // namespace cascade::checking
