// The option `--dump` prints any intermediate form of a script as text, from tokens to assembly.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// Returns the kinds of dumps: tokens, ast, equations, tex, program, graph, plan, ir, llvm, asm.
std::span<const std::string_view> dump_kinds();

/// Dumps a loaded script. If the script has errors, only the kinds `tokens` and `ast` work.
Result<std::string> dump(const Script& script, std::string_view kind);

}  // namespace cascade
