// Finds the parameter that an option names.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// The parameter with this name, such as "feed", in a stage. The name of the stage or its system
/// may precede the parameter's name. Fails if there is no such parameter, or if its value differs
/// from cell to cell.
Result<ItemId> find_parameter(const Program& program, std::uint32_t stage, std::string_view name);

/// What a number for this parameter, such as an end of a range, is multiplied by. Such a number is
/// in the unit of the value that it replaces, as with --set: the factor converts it to the units in
/// which the script computes. 1 if that value has no unit.
double unit_factor(const ast::Script& script, std::string_view name);

}  // namespace cascade
