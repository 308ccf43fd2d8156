// Checks whether the units of a script are consistent (spec/units.md).
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/script_units.h"

#include <string>
#include <vector>

namespace cascade {

/// The units of a program's values. The unit of a value is empty if the script gives none.
struct ProgramUnits {
    ScriptUnits units;
    /// For each stage, the unit of each item.
    std::vector<IdVector<ItemId, std::optional<Dimension>>> items;

    /// The unit of a quantity such as length or time. Empty if the script gives no unit for the
    /// quantity.
    std::string name_of(BaseQuantity quantity) const {
        return units.knows(quantity) ? units.name_of(Dimension::of(quantity)) : "";
    }
    /// The unit of an item of a stage; empty if the item has none.
    std::string name_of(std::uint32_t stage, ItemId item) const {
        const auto& dimension = items[stage][item];
        return dimension ? units.name_of(*dimension) : "";
    }
};

/// Reports formulas in which two units contradict each other. The program must be free of errors.
/// Must be called before let_lengths_grow().
void check_dimensions(const ast::Script& script, const Sources& sources, const Program& program,
                      Diagnostics& diagnostics);

/// The unit of a formula in a stage, such as the formula that a picture shows. Empty if the formula
/// has no unit.
std::string unit_of_formula(const ast::Script& script, const Program& program, std::uint32_t stage,
                            const Formula& formula);

/// The units of a checked program.
ProgramUnits units_of_program(const ast::Script& script, const Program& program);

}  // namespace cascade
