// Finds the parameter that an option names.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"
#include "run/commands/variation.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// Returns the parameter with this name, such as "feed", in a stage. The name of the stage or of
/// its system may precede the parameter's name. Fails if there is no such parameter, or if its
/// value differs from cell to cell.
Result<ItemId> find_parameter(const Program& program, std::uint32_t stage, std::string_view name);

/// The unit of numbers for this parameter, such as the ends of a range: the unit of the value that
/// they replace, as with --set. Empty if that value has no unit.
std::string_view unit_of_numbers(const ast::Script& script, std::string_view name);

/// What a number in unit_of_numbers() is multiplied by to convert it to the units in which the
/// script computes.
double unit_factor(const ast::Script& script, std::string_view name);

/// The same for the ends of a range, which may have a unit. Fails if the range has a unit, but the
/// value that it replaces has none or measures something else.
Result<double> unit_factor(const ast::Script& script, const VariedRange& range);

}  // namespace cascade
