// The units in which a script computes, and the numbers of the script that have a unit.
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
/// `largest_step`. Every other quantity is in the first unit of the script that measures it, and so
/// are lengths and times if these settings have no unit. A quantity that no unit of the script
/// measures is in m, s, mol, kg, A or K.
class ScriptUnits {
public:
    ScriptUnits();

    /// Whether a unit of this script measures the quantity. Units such as m measure length, but l
    /// and M do not. Every unit that contains a time measures time.
    bool knows(BaseQuantity quantity) const { return known_[static_cast<std::size_t>(quantity)]; }
    /// Whether no number of the script has a unit.
    bool empty() const;
    /// Converts a number in `unit` to the script's units.
    double convert(double number, const Unit& unit) const;
    /// The unit that numbers of this dimension have in this script: `um^2/s`. Empty for plain
    /// numbers.
    std::string name_of(const Dimension& dimension) const;

    friend ScriptUnits units_of(const ast::Script& script);

private:
    struct Base {
        std::string name;
        Dimension dimension;  ///< Of the unit `name`, which may measure further quantities.
        Unit size;            ///< The unit of the base quantity alone.
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

/// The unit of an expression that is one number with a unit, or such a number with a sign. Empty
/// for all other expressions.
std::string_view unit_text_of(const ast::Script& script, ast::Expression expression);

/// The unit of the value that `--set name=…` replaces, or `--set stage.name=…` if `stage` is not
/// empty. Empty if this value is not one number with a unit.
std::string_view unit_of_value(const ast::Script& script, std::string_view stage,
                               std::string_view name);

/// If the expression is the script's last one and is a number without a unit, gives it `unit`.
void give_unit(ast::Script& script, ast::Expression& expression, std::string_view unit);

/// The parts of a script that have a unit: the dimension of each, by its source location.
class MeasuredSpans {
public:
    MeasuredSpans() = default;
    explicit MeasuredSpans(const ast::Script& script);
    /// Null if the part at this location is neither a number with a unit nor a length of the
    /// domain.
    const Dimension* find(Span span) const;

private:
    std::map<std::tuple<SourceId, std::uint32_t, std::uint32_t>, Dimension> dimensions_;
};

}  // namespace cascade
