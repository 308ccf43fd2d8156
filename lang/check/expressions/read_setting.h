// Reads settings whose values are described by their row in settings.def (internal to the checker).
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <cstddef>
#include <optional>

namespace cascade::checking {

/// Whether the statement has exactly one value. Otherwise reports an error at the second value.
bool has_one_value(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// The number given to a setting. Reports an error and returns nothing if the setting's row does
/// not allow it.
std::optional<double> read_number(Workspace& work, const ast::Script& script,
                                  const ast::Statement& statement);
/// The word given to a setting, as its position among the words in the setting's row. Reports an
/// error and returns nothing if the row does not contain the word.
std::optional<std::size_t> read_word(Workspace& work, const ast::Script& script,
                                     const ast::Statement& statement);

/// Assigns a value to the target, if there is one.
template <typename Target, typename Value>
void put(Target& target, const std::optional<Value>& value) {
    if (value) target = static_cast<Target>(*value);
}
template <typename Target, typename Value>
void put(std::optional<Target>& target, const std::optional<Value>& value) {
    if (value) target = static_cast<Target>(*value);
}

}  // namespace cascade::checking
