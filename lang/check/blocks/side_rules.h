// Rules at the sides of the grid and the border of a mask (internal to the checker): `u.left:
// fixed(1)` in a system or a stage, `left: fixed(0)` for all species in the domain.
#pragma once

#include "lang/check/expressions/check_expression.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// A parsed rule: its kind, and the expression of its value.
struct WrittenSide {
    SideKind kind = SideKind::no_flux;
    std::optional<ast::Expression> value;
};

/// Parses `periodic`, `noflux`, `fixed(e)`, `slope(e)` or `flux(e)`; reports errors.
std::optional<WrittenSide> read_side(Workspace& work, const ast::Script& script,
                                     const ast::Statement& statement);

/// The border's rule where there is no mask: it has no effect, which is said once.
void leave_border(Workspace& work, SideSetting& border);

/// The sides that a word means; empty if it means none.
std::vector<Side> sides_of_word(std::string_view word);

/// Reports an error and returns false if the value of a side needs other cells than those beside it
/// whenever rates are evaluated. Definitions are not looked into.
bool is_known_along_side(Workspace& work, const System& system, const Formula& value);

/// The rules of statements about sides of species, in an order in which later ones replace earlier
/// ones; reports errors.
std::vector<SubjectSide> read_side_rules(Workspace& work, const ast::Script& script,
                                         const Scope& scope,
                                         std::span<const ast::Statement> statements);

}  // namespace cascade::checking
