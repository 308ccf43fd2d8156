// Units after numbers, such as the m^2/s of `D: 1e-14 m^2/s` (spec/units.md).
#pragma once

#include "lang/syntax/token.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>

namespace cascade {

/// The names that the script declares: species, parameters, definitions, constants, indices,
/// parameters of functions. In this script none of them is a unit.
std::unordered_set<std::string_view> declared_names(std::span<const Token> tokens);

/// Returns the ASCII spelling of a name with Greek letters, which the source writes as `name` at
/// `offset`, after the tokens `before`. This is `spelling`, except in a unit after a number, where
/// µ is the prefix u, not the letter mu.
std::string spelling_in_unit(const std::string& spelling, std::string_view name,
                             std::span<const Token> before, std::size_t offset);

/// A unit after a number, or why there is none.
struct UnitSuffix {
    std::size_t tokens = 0;  ///< How many tokens it has. 0 if no unit follows.
    std::string text;        ///< As unit_of() reads it: `m^2/s`, `1/s`.
    // The error; its message is empty if there is none.
    Span span;
    std::string message, hint;
};

/// The unit that begins at `at`, directly after a number. A blank precedes a unit. Signs between
/// its factors have no blanks beside them.
UnitSuffix unit_suffix(std::span<const Token> tokens, std::size_t at,
                       const std::unordered_set<std::string_view>& declared);

}  // namespace cascade
