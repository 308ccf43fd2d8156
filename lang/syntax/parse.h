// The parser: turns tokens into a syntax tree.
//
// Statements are parsed by recursive descent of fixed depth, and expressions by operator precedence
// with an explicit stack. So neither 100,000 brackets nor 1,000,000 operands overflow the call
// stack. spec/grammar.md has the grammar.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

#include <optional>
#include <string>

namespace cascade {

/// The largest size of a script, in bytes. A larger script is refused before it is parsed.
inline constexpr std::size_t largest_script = 16u << 20;

/// Parses a whole script. Reports errors to `diagnostics`. After an error, continues at the next
/// statement, so one call finds all errors.
ast::Script parse(SourceId source, const Sources& sources, Diagnostics& diagnostics);

/// Parses a text that another script uses. Adds to `script` the systems and functions of this text,
/// and of the texts that this text uses. Ignores stages, domain and picture.
void parse_used(SourceId source, const Sources& sources, ast::Script& script,
                Diagnostics& diagnostics);

/// Parses a text that is a single expression, as in `--show 'small.b - a'`. Adds its nodes to the
/// lists of `script`.
std::optional<ast::Expression> parse_expression(SourceId source, const Sources& sources,
                                                ast::Script& script, Diagnostics& diagnostics);

/// Parses `[stage.]name=expression`, or the same with `:`, as in `--set`. Adds the override to
/// `script.overrides`.
void parse_override(SourceId source, const Sources& sources, ast::Script& script,
                    Diagnostics& diagnostics);

/// Prints the syntax tree as indented text, for `--dump ast`.
std::string print_ast(const ast::Script& script, const Sources& sources);

}  // namespace cascade
