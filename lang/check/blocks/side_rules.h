// Rules at the sides of the grid and at the border of a mask (internal to the checker). Examples
// are `u.left: fixed(1)` in a system or a stage, and `left: fixed(0)` for all species in the
// domain.
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// A parsed rule: the kind of the rule, and the expression of its value.
struct WrittenSide {
    SideKind kind = SideKind::no_flux;
    std::optional<ast::Expression> value;
};

/// Parses `periodic`, `noflux`, `fixed(e)`, `slope(e)` or `flux(e)`. Reports errors.
std::optional<WrittenSide> read_side(Workspace& work, const ast::Script& script,
                                     const ast::Statement& statement);

/// If there is no mask, resets the rule for the border of the mask, and reports only once that the
/// rule has no effect.
void leave_border(Workspace& work, SideSetting& border);

/// The sides to which a word refers. Empty if the word does not mean a side.
std::vector<Side> sides_of_word(std::string_view word);

/// Whether the value of a side can be computed, each time the rates are evaluated, only from the
/// cells beside the side. If not, reports an error. Formulas of definitions are not examined.
bool is_known_along_side(Workspace& work, const System& system, const Formula& value);

/// Reads the rules in statements about sides of species. In the result, a later rule replaces an
/// earlier rule for the same side and species. Reports errors.
std::vector<SubjectSide> read_side_rules(Workspace& work, const ast::Script& script,
                                         const Scope& scope,
                                         std::span<const ast::Statement> statements);

}  // namespace cascade::checking
