// Lengths of the domain in expressions (internal to the checker): positions and sides in the
// script's unit of length, and integrals.
//
//     domain.x            becomes   x * 10       on a grid whose longest side is 10 long
//     domain.spacing      becomes   0.05
//     integral(e over domain)       sum(e over domain) * 0.05^2    on a plane
//
// If lengths may grow, each of these numbers becomes (grown)(number, axis).
#pragma once

#include "lang/check/names/check_names.h"

#include <string_view>

namespace cascade::checking {

/// The word before the dot, as in domain.x.
inline constexpr std::string_view domain_word = "domain";
/// The aggregate in which each cell counts with its length, area or volume.
inline constexpr std::string_view integral_word = "integral";

/// The second operand of `(grown)` if the length has no direction, like the side of a cell.
inline constexpr int all_axes = 3;

/// A length of the domain: the number `factor`, multiplied by the built-in value `builtin` if there
/// is one.
struct DomainLength {
    std::string_view builtin;  ///< The name of the built-in value; empty if there is none.
    double factor = 0;
    int axis = all_axes;  ///< The axis along which the length grows if the domain grows.
};

/// The length to which the name after `domain.` refers. Reports an error if there is no such
/// length, or if it cannot be read in this scope.
std::optional<DomainLength> domain_length(Workspace& work, const Scope& scope,
                                          const ast::Word& name);

/// The length, area or volume of a cell of the grid. On models and surfaces the result is 1,
/// because sums over their cells are already integrals.
double content_of_cell(const Program& program);

/// The name after `domain.` in an expression; null if the expression does not have this form.
const ast::Word* name_of_length(const ast::Script& script, const ast::Expr& expr);
/// Whether the aggregate is integral(e over domain).
bool is_integral(const ast::Over& over);

}  // namespace cascade::checking
