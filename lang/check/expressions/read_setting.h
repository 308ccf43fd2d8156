// Reads the settings whose allowed values are in their row of settings.def (internal to the
// checker).
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <cstddef>
#include <optional>

namespace cascade::checking {

/// Whether the statement has exactly one value. If not, reports an error at the second value.
bool has_one_value(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// The number that a setting has. If the setting's row does not allow the number, reports an error
/// and returns nullopt.
std::optional<double> read_number(Workspace& work, const ast::Script& script,
                                  const ast::Statement& statement);
/// The word that a setting has, as its position among the words in the setting's row. If the row
/// does not contain the word, reports an error and returns nullopt.
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
