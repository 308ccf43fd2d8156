// The parser: tokens to syntax tree.
//
// Statements are parsed by recursive descent of fixed depth, expressions by operator precedence
// with an explicit stack, so that neither 100,000 brackets nor 1,000,000 operands overflow the call
// stack. The grammar is in spec/grammar.md.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

#include <optional>
#include <string>

namespace cascade {

/// The largest script in bytes. A larger one is refused before it is read.
inline constexpr std::size_t largest_script = 16u << 20;

/// Parses a whole script. Errors go to `diagnostics`. After each, parsing continues at the next
/// statement, so that one call finds them all.
ast::Script parse(SourceId source, const Sources& sources, Diagnostics& diagnostics);

/// Parses a text that another script uses: adds its systems and functions, and those of the texts
/// that it uses, to `script`. Ignores its stages, domain and picture.
void parse_used(SourceId source, const Sources& sources, ast::Script& script,
                Diagnostics& diagnostics);

/// Parses a text that is one expression (`--show 'small.b - a'`) into the lists of `script`.
std::optional<ast::Expression> parse_expression(SourceId source, const Sources& sources,
                                                ast::Script& script, Diagnostics& diagnostics);

/// Parses `[stage.]name=expression` (or with `:`), as `--set` takes it, into `script.overrides`.
void parse_override(SourceId source, const Sources& sources, ast::Script& script,
                    Diagnostics& diagnostics);

/// The tree as indented text, for `--dump ast`.
std::string print_ast(const ast::Script& script, const Sources& sources);

}  // namespace cascade
