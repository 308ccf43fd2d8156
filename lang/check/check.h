// The checker: syntax tree to checked program.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Resolves and checks everything; the systems of the library that the script names are added to
/// `sources` and to the program (lang/library/library.h). On errors the result is empty and
/// `diagnostics` says why; there may be warnings beside a result. Does not touch files: the paths
/// in `field("a.npy")` are only collected. A script without stages is fine here (`systems`, the
/// prompt); run refuses it.
std::optional<Program> check(const ast::Script& script, Sources& sources, Diagnostics& diagnostics);

/// Checks an expression for a picture (`--show`, `picture { color: … }`): bare names are items of
/// `stage`, `[p]` too, `other.p` any stage up to `last_stage`. What it names by number is added to
/// the literals of the program.
std::optional<Formula> check_view(const ast::Script& script, ast::Expression expression,
                                  std::uint32_t stage, std::uint32_t last_stage,
                                  const Program& program, const Sources& sources,
                                  Diagnostics& diagnostics);

/// The `color:` statement of the script's picture block, if it has one.
std::optional<ast::Expression> picture_expression(const ast::Script& script);

/// All names a user can type at the top of an expression or statement, for completion.
std::vector<std::string> known_names(const Program& program);

}  // namespace cascade
