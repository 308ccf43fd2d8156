// Tokens and the lexer, which turns text into tokens.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// CASCADE_TOKEN(name, spelling). `spelling` appears in messages and in `--dump tokens`.
#define CASCADE_TOKENS(CASCADE_TOKEN)                                                      \
    CASCADE_TOKEN(end_of_text, "end of text")                                              \
    CASCADE_TOKEN(newline, "line end")                                                     \
    CASCADE_TOKEN(name, "name")                                                            \
    CASCADE_TOKEN(number, "number")                                                        \
    CASCADE_TOKEN(text, "text in quotes")                                                  \
    CASCADE_TOKEN(garbage, "unreadable characters")                                        \
    CASCADE_TOKEN(keyword_and, "and")                                                      \
    CASCADE_TOKEN(keyword_or, "or")                                                        \
    CASCADE_TOKEN(keyword_not, "not")                                                      \
    CASCADE_TOKEN(colon, ":")                                                              \
    CASCADE_TOKEN(semicolon, ";")                                                          \
    CASCADE_TOKEN(comma, ",")                                                              \
    CASCADE_TOKEN(dot, ".")                                                                \
    CASCADE_TOKEN(dots, "..")                                                              \
    CASCADE_TOKEN(prime, "'")                                                              \
    CASCADE_TOKEN(open_round, "(")                                                         \
    CASCADE_TOKEN(close_round, ")")                                                        \
    CASCADE_TOKEN(open_square, "[")                                                        \
    CASCADE_TOKEN(close_square, "]")                                                       \
    CASCADE_TOKEN(open_curly, "{")                                                         \
    CASCADE_TOKEN(close_curly, "}")                                                        \
    CASCADE_TOKEN(assign, "=")                                                             \
    CASCADE_TOKEN(plus_assign, "+=")                                                       \
    CASCADE_TOKEN(equal, "==")                                                             \
    CASCADE_TOKEN(not_equal, "!=")                                                         \
    CASCADE_TOKEN(less, "<")                                                               \
    CASCADE_TOKEN(less_equal, "<=")                                                        \
    CASCADE_TOKEN(greater, ">")                                                            \
    CASCADE_TOKEN(greater_equal, ">=")                                                     \
    CASCADE_TOKEN(plus, "+")                                                               \
    CASCADE_TOKEN(minus, "-")                                                              \
    CASCADE_TOKEN(star, "*")                                                               \
    CASCADE_TOKEN(slash, "/")                                                              \
    CASCADE_TOKEN(caret, "^")                                                              \
    /* Signs of papers, taken apart by paper_notation.h and bars.h: lex() returns none. */ \
    CASCADE_TOKEN(nabla, "∇")                                                              \
    CASCADE_TOKEN(laplacian, "Δ")                                                          \
    CASCADE_TOKEN(partial, "∂")                                                            \
    CASCADE_TOKEN(root, "√")                                                               \
    CASCADE_TOKEN(superscript, "superscript")                                              \
    CASCADE_TOKEN(bar, "|")

enum class TokenKind : std::uint8_t {
#define CASCADE_TOKEN(name, spelling) name,
    CASCADE_TOKENS(CASCADE_TOKEN)
#undef CASCADE_TOKEN
};

std::string_view spelling(TokenKind kind);

struct Token {
    TokenKind kind = TokenKind::end_of_text;
    /// The token's source location. Empty for a token that the notation of papers omits, such as
    /// the `*` in `D ∇²u`.
    Span span;
    /// The token's ASCII spelling for the parser: `beta` for β, `lap` for ∇². A view of the source,
    /// or of memory that lives as long as the process.
    std::string_view text = {};
};

/// The largest number of tokens in a script. The limit bounds the memory that later passes need. A
/// script with more tokens is refused with one message.
inline constexpr std::size_t most_tokens = 1u << 22;

/// Splits a source into tokens. The last token is end_of_text. Line breaks are tokens, and several
/// line breaks in a row become one token. Comments and blanks are dropped. The notation of papers
/// becomes equivalent tokens (paper_notation.h). Bad input is a stray character, invalid UTF-8,
/// NUL, an unclosed string, or a look-alike such as ’ – ÷. It is reported once for each run of
/// characters, so that one mistake gives one message. A run becomes the token `garbage`, and a run
/// of look-alikes becomes the token that was meant. If `docs` is given, the locations of doc
/// comments (`## text`) are added to it. `###` begins an ordinary comment.
std::vector<Token> lex(SourceId source, const Sources& sources, Diagnostics& diagnostics,
                       std::vector<Span>* docs = nullptr);

/// Prints tokens as text, one per line: `3:5 name "ka"`.
std::string print_tokens(const std::vector<Token>& tokens, const Sources& sources);

}  // namespace cascade
