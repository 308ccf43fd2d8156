// Reads the notation of papers, ∂u/∂t = D ∇²u + u²v, as the tokens of u' = D * lap(u) + u^2 * v.
//
// The notation is converted between the lexer and the parser, so the parser and all later passes
// know only one notation. spec/grammar.md defines the notation.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/token.h"

#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// Whether tokens of this kind occur only in the notation of papers.
bool is_sign_of_papers(TokenKind kind);

/// '0' … '9' if the character is a superscript digit, and '-' if it is a superscript minus. nullopt
/// for other characters.
std::optional<char> superscript_digit(char32_t code_point);

/// Whether the word is `over`, `in`, `step` or `after`, which are written between operands like
/// operators.
bool is_word_between_operands(std::string_view word);

/// Converts tokens to equivalent tokens of Cascade. Tokens that the source omits (brackets, the
/// sign of a product) have an empty span. Reports ambiguous notation.
std::vector<Token> without_paper_notation(const std::vector<Token>& tokens, std::string_view text,
                                          Diagnostics& diagnostics);

}  // namespace cascade
