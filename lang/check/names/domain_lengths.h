// Lengths of the domain in expressions (internal to the checker): places and sides in the unit of
// the spacing, and integrals.
//
//     domain.x            becomes   x * 10       on a grid whose longest side is 10 long
//     domain.spacing      becomes   0.05
//     integral(e over domain)       sum(e over domain) * 0.05^2    on a plane
#pragma once

#include "lang/check/names/check_names.h"

#include <string_view>

namespace cascade::checking {

/// The word before the dot.
inline constexpr std::string_view domain_word = "domain";
/// The aggregate that counts each cell with its length, area or volume.
inline constexpr std::string_view integral_word = "integral";

/// A length: `factor` itself, or `factor` times a built-in value.
struct DomainLength {
    std::string_view builtin;  ///< Empty if there is none.
    double factor = 0;
};

/// What the name after `domain.` means; an error is reported if it means nothing, or nothing here.
std::optional<DomainLength> domain_length(Workspace& work, const Scope& scope,
                                          const ast::Word& name);

/// The length, area or volume of a cell of the grid; 1 where sums are integrals by themselves, on
/// models and surfaces.
double content_of_cell(const Program& program);

/// The name after `domain.`; null for other expressions.
const ast::Word* name_of_length(const ast::Script& script, const ast::Expr& expr);
/// Is it integral(e over domain)?
bool is_integral(const ast::Over& over);

}  // namespace cascade::checking
