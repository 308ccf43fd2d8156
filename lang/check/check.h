// The checker: turns a syntax tree into a checked program.
#pragma once

#include "core/diagnostics.h"
#include "lang/check/names/name_uses.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string_view>

namespace cascade {

/// Resolves and checks a script. If the script has syntax errors, they must already be in
/// `diagnostics`. The library systems that the script names are added to `sources` and to the
/// program (lang/library/library.h). Errors and warnings are added to `diagnostics`. Returns
/// nullopt if there are errors. Reads no files: the paths in `field("a.npy")` are only collected. A
/// script without stages is accepted, because `cascade systems` and the prompt check such scripts.
/// `uses` receives the uses of names, even if the script has errors, and may be null.
std::optional<Program> check(const ast::Script& script, Sources& sources, Diagnostics& diagnostics,
                             NameUses* uses = nullptr);

/// Checks an expression for a picture (`--show`, `picture { color: … }`). Bare names and `[p]` mean
/// items of `stage`. `other.p` means an item of the stage `other`, which must not come after
/// `last_stage`. The strings of the expression are added to the program's literals, and the formula
/// refers to them by index.
std::optional<Formula> check_view(const ast::Script& script, ast::Expression expression,
                                  std::uint32_t stage, std::uint32_t last_stage,
                                  const Program& program, const Sources& sources,
                                  Diagnostics& diagnostics);

}  // namespace cascade
