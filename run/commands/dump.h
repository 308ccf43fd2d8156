// `--dump`: any intermediate form of a script, from tokens to assembly, as text.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// tokens, ast, equations, tex, program, graph, plan, ir, llvm, asm.
std::span<const std::string_view> dump_kinds();

/// The dump of a loaded script. tokens and ast work for a script with errors, too.
Result<std::string> dump(const Script& script, std::string_view kind);

}  // namespace cascade
