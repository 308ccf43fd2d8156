// The checker: syntax tree to checked program.
#pragma once

#include "core/diagnostics.h"
#include "lang/check/names/name_uses.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string_view>

namespace cascade {

/// Resolves and checks a script; systems of the library that it names are added to `sources` and to
/// the program (lang/library/library.h). Returns nothing if there are errors, which are then in
/// `diagnostics`; warnings may come with a result. Does not touch files: the paths in
/// `field("a.npy")` are only collected. Accepts a script without stages, as `systems` and the
/// prompt need; `run` refuses it.
/// `uses` receives what names refer to, also of a script with errors; null if nobody asks.
std::optional<Program> check(const ast::Script& script, Sources& sources, Diagnostics& diagnostics,
                             NameUses* uses = nullptr);

/// Checks an expression for a picture (`--show`, `picture { color: … }`): bare names and `[p]` are
/// items of `stage`, `other.p` one of any stage up to `last_stage`. Strings that it refers to by
/// number are added to the literals of the program.
std::optional<Formula> check_view(const ast::Script& script, ast::Expression expression,
                                  std::uint32_t stage, std::uint32_t last_stage,
                                  const Program& program, const Sources& sources,
                                  Diagnostics& diagnostics);

}  // namespace cascade
