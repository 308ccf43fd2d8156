// Systems as equations like those in papers, in Unicode for a terminal or in TeX. spec/equations.md
// has the table of notations.
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

/// The parts of a system to print.
enum class EquationParts : std::uint8_t {
    rates,  ///< Rates, definitions and invariants.
    all,    ///< Also parameters and starting values.
};

/// The equations of a system of the script or else of the library, including everything inherited.
/// Lines end with a newline. Empty if there is no such system. The script must be free of errors.
std::string print_equations(const ast::Script& script, const Sources& sources,
                            std::string_view system, Notation notation, EquationParts parts);

/// The equations of several systems.
std::vector<std::string> print_equations(const ast::Script& script, const Sources& sources,
                                         std::span<const std::string_view> systems,
                                         Notation notation, EquationParts parts);

/// The equation or value of one name in a system of the script or else of the library, in MathML:
/// the rate of a species, a definition, or the value of a parameter. Empty if the system does not
/// set it.
std::string equation_in_mathml(const ast::Script& script, const Sources& sources,
                               std::string_view system, std::string_view name);

}  // namespace cascade
