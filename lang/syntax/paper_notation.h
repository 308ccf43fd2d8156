// The notation of papers: ∂u/∂t = D ∇²u + u²v, read as the tokens of u' = D * lap(u) + u^2 * v.
//
// It is converted between the lexer and the parser, so that everything after them knows only one
// notation. spec/grammar.md defines it.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/token.h"

#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// True for the kinds of tokens that only the notation of papers has.
bool is_sign_of_papers(TokenKind kind);

/// '0' … '9' or '-' for a superscript digit or minus. Empty for other characters.
std::optional<char> superscript_digit(char32_t code_point);

/// True for `over`, `in`, `step` and `after`, which come between operands like operators.
bool is_word_between_operands(std::string_view word);

/// The equivalent tokens of the language. Tokens missing in the source (brackets, the sign of a
/// product) have an empty span. Reports ambiguous notation.
std::vector<Token> without_paper_notation(const std::vector<Token>& tokens, std::string_view text,
                                          Diagnostics& diagnostics);

}  // namespace cascade
