// Prints the equations of systems in the notation of papers, in Unicode for a terminal or in TeX.
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
    unicode,  ///< Lines of text in Unicode.
    tex,      ///< Align environments of the TeX package amsmath.
};

/// Which parts of a system to print.
enum class EquationParts : std::uint8_t {
    rates,  ///< Only rates, definitions and invariants.
    all,    ///< Also parameters and starting values.
};

/// Prints the equations of a system, including everything that it inherits. The system is searched
/// for in the script and, if the script does not have it, in the library. Lines end with a newline.
/// Empty if there is no such system. The script must be free of errors.
std::string print_equations(const ast::Script& script, const Sources& sources,
                            std::string_view system, Notation notation, EquationParts parts);

/// Prints the equations of several systems, in the order of `systems`.
std::vector<std::string> print_equations(const ast::Script& script, const Sources& sources,
                                         std::span<const std::string_view> systems,
                                         Notation notation, EquationParts parts);

/// The equation or value of one name in a system, in MathML: the rate of a species, a definition,
/// or the value of a parameter. The system is found as in print_equations(). Empty if the system
/// has no statement for the name.
std::string equation_in_mathml(const ast::Script& script, const Sources& sources,
                               std::string_view system, std::string_view name);

/// The same equation as a line of text, such as "∂u/∂t = D ∇²u", without a line end.
std::string equation_in_unicode(const ast::Script& script, const Sources& sources,
                                std::string_view system, std::string_view name);

}  // namespace cascade
