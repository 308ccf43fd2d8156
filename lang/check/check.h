// The checker: turns a syntax tree into a checked program.
#pragma once

#include "core/diagnostics.h"
#include "lang/check/names/name_uses.h"
#include "lang/program/program.h"
#include "lang/syntax/ast.h"

#include <optional>
#include <string_view>

namespace cascade {

/// Resolves and checks a script. If it has syntax errors, they must be in `diagnostics`. The
/// library systems that the script names are added to `sources` and to the program
/// (lang/library/library.h). Errors and warnings are added to `diagnostics`. Returns nothing if
/// there are errors. Reads no files: the paths in `field("a.npy")` are only collected. A script
/// without stages is accepted, because `cascade systems` and the prompt check such scripts. `uses`
/// receives the uses of names, also for a script with errors. It may be null.
std::optional<Program> check(const ast::Script& script, Sources& sources, Diagnostics& diagnostics,
                             NameUses* uses = nullptr);

/// Checks an expression for a picture (`--show`, `picture { color: … }`). Bare names and `[p]` mean
/// items of `stage`; `other.p` means an item of any stage up to `last_stage`. The formula refers to
/// strings by their index in the program's literals, to which strings of the expression are added.
std::optional<Formula> check_view(const ast::Script& script, ast::Expression expression,
                                  std::uint32_t stage, std::uint32_t last_stage,
                                  const Program& program, const Sources& sources,
                                  Diagnostics& diagnostics);

}  // namespace cascade
