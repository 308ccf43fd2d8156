// The units in which a script computes, and the parts of a script that have a unit.
#pragma once

#include "lang/syntax/ast.h"
#include "lang/vocabulary/units.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace cascade {

/// The unit in which the script computes each base quantity. Lengths are in the unit of the
/// domain's `extent` or `spacing`, and times in the unit of a `duration`, `every`, `speed` or
/// `largest_step`. Every other quantity is in the first unit in the script that measures this
/// quantity. The same holds for lengths and times if these settings have no unit. A quantity that
/// no unit in the script measures is in its base unit: m, s, mol, kg, A or K.
class ScriptUnits {
public:
    ScriptUnits();

    /// Whether a unit of this script measures the quantity. For length, units such as m count, but
    /// l and M do not. For time, every unit that contains a time counts.
    bool knows(BaseQuantity quantity) const { return known_[static_cast<std::size_t>(quantity)]; }
    /// Whether no number in the script has a unit.
    bool empty() const;
    /// Converts a number in `unit` to the script's units.
    double convert(double number, const Unit& unit) const;
    /// The unit that numbers of this dimension have in this script: `um^2/s`. Empty for numbers
    /// without a unit.
    std::string name_of(const Dimension& dimension) const;

    friend ScriptUnits units_of(const ast::Script& script);

private:
    struct Base {
        std::string name;
        /// The dimension of the unit `name`, which may also measure other quantities.
        Dimension dimension;
        Unit size;  ///< The unit of the base quantity alone.
        bool is_given = false;
    };

    void take_plain(std::string_view text, BaseQuantity quantity);
    void take_others(std::string_view text);
    void note_known(std::string_view text);
    Unit size_of(const Dimension& dimension) const;

    std::array<Base, base_quantity_count> bases_;
    std::array<bool, base_quantity_count> known_{};
};

ScriptUnits units_of(const ast::Script& script);

/// The unit of an expression that consists of one number with a unit, with or without a sign. Empty
/// for all other expressions.
std::string_view unit_text_of(const ast::Script& script, ast::Expression expression);

/// The unit of the value that `--set name=…` replaces. If `stage` is not empty, the unit of the
/// value that `--set stage.name=…` replaces. Empty if the value is not one number with a unit.
std::string_view unit_of_value(const ast::Script& script, std::string_view stage,
                               std::string_view name);

/// Gives `unit` to an expression if it is the last expression of the script and a number without a
/// unit.
void give_unit(ast::Script& script, ast::Expression& expression, std::string_view unit);

/// Maps the source location of each number with a unit, and of each length of the domain, to its
/// dimension.
class MeasuredSpans {
public:
    MeasuredSpans() = default;
    explicit MeasuredSpans(const ast::Script& script);
    /// The dimension of the part at this location. Null if the part is neither a number with a unit
    /// nor a length of the domain.
    const Dimension* find(Span span) const;

private:
    std::map<std::tuple<SourceId, std::uint32_t, std::uint32_t>, Dimension> dimensions_;
};

}  // namespace cascade
