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
/// parameters of functions. In this script none of these names is a unit.
std::unordered_set<std::string_view> declared_names(std::span<const Token> tokens);

/// Returns the ASCII spelling of a name with Greek letters. In the source, the name is written as
/// `name` at `offset`, after the tokens `before`. The result is `spelling`, except in a unit after
/// a number, where µ is the prefix u and not the letter mu.
std::string spelling_in_unit(const std::string& spelling, std::string_view name,
                             std::span<const Token> before, std::size_t offset);

/// A unit after a number, or the reason why there is none.
struct UnitSuffix {
    std::size_t tokens = 0;  ///< How many tokens the unit has. 0 if no unit follows.
    std::string text;        ///< The unit as unit_of() reads it: `m^2/s`, `1/s`.
    // The error. `message` is empty if there is no error.
    Span span;
    std::string message, hint;
};

/// Reads the unit that begins at token `at`, directly after a number. There must be a blank before
/// the unit, and no blanks beside the signs in it.
UnitSuffix unit_suffix(std::span<const Token> tokens, std::size_t at,
                       const std::unordered_set<std::string_view>& declared);

}  // namespace cascade
