// Reads settings whose row in settings.def says which values they take (internal to the checker).
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <cstddef>
#include <optional>

namespace cascade::checking {

/// True if the statement has one value; reports an error at the second value otherwise.
bool has_one_value(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// The number that a setting is given; reports an error and returns nothing if it is not one of its
/// row.
std::optional<double> read_number(Workspace& work, const ast::Script& script,
                                  const ast::Statement& statement);
/// The position in its row of the word that a setting is given.
std::optional<std::size_t> read_word(Workspace& work, const ast::Script& script,
                                     const ast::Statement& statement);

/// Puts a value where it belongs, if there is one.
template <typename Target, typename Value>
void put(Target& target, const std::optional<Value>& value) {
    if (value) target = static_cast<Target>(*value);
}
template <typename Target, typename Value>
void put(std::optional<Target>& target, const std::optional<Value>& value) {
    if (value) target = static_cast<Target>(*value);
}

}  // namespace cascade::checking
