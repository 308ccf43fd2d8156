// Systems as the equations one finds in papers, in Unicode for a terminal or in TeX.
//
// spec/equations.md has the table of notations.
#pragma once

#include "core/source.h"
#include "lang/syntax/ast.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

enum class Notation : std::uint8_t {
    unicode,  ///< Lines of text.
    tex,      ///< Align environments of the package amsmath.
};

/// How much is said of a system.
enum class EquationParts : std::uint8_t {
    rates,  ///< Rates, definitions and invariants.
    all,    ///< Also parameters and starting values.
};

/// The equations of a system of the script or, where the script has none of this name, of the
/// library. A system derived from another is shown as a whole. Lines end with a line end. Empty
/// if there is no such system. The script must be one that passes the checks.
std::string print_equations(const ast::Script& script, const Sources& sources,
                            std::string_view system, Notation notation, EquationParts parts);

/// The same of several systems.
std::vector<std::string> print_equations(const ast::Script& script, const Sources& sources,
                                         std::span<const std::string_view> systems,
                                         Notation notation, EquationParts parts);

}  // namespace cascade
