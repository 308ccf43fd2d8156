// A position in a list of tokens, shared by the parsers of statements and of expressions.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Moves over the tokens of one source, never beyond end_of_text.
class TokenCursor {
public:
    TokenCursor(SourceId source, const Sources& sources, Diagnostics& diagnostics);

    const Token& peek(std::size_t ahead = 0) const;
    TokenKind kind(std::size_t ahead = 0) const { return peek(ahead).kind; }
    bool at(TokenKind kind) const { return peek().kind == kind; }
    bool at_end() const { return at(TokenKind::end_of_text); }
    /// The last token taken that is not a line break, or the first token before any was taken.
    const Token& previous() const;
    /// The end of the last token taken, line breaks included. 0 if only line breaks were taken.
    std::uint32_t taken_up_to() const;
    Token take();
    bool take_if(TokenKind kind);
    /// Moves back to the token taken last.
    void step_back();
    void skip_newlines() { take_if(TokenKind::newline); }
    /// The same inside brackets, unless the next line begins a statement: then the closing bracket
    /// is missing.
    void skip_newlines_in_brackets() {
        if (at(TokenKind::newline) && !begins_statement(1)) take();
    }
    std::size_t position() const { return position_; }
    std::size_t token_count() const { return tokens_.size(); }

    /// The text for the parser: ASCII in a script without errors.
    std::string_view text(const Token& token) const { return token.text; }
    std::string_view text(Span span) const { return sources_.text(span); }
    /// What follows the token in its line, comments included.
    std::string_view rest_of_line(const Token& token) const;
    ast::Word word(const Token& token) const { return {token.span, text(token)}; }
    /// The token in messages: `'beta'`, `the end of the line`. Long ones are cut.
    std::string describe(const Token& token) const;

    /// The text of the doc comments that begin in [begin, end) of the source, joined by blanks,
    /// without those taken before.
    std::string take_docs(std::uint32_t begin, std::uint32_t end);
    /// Warns of doc comments that were not taken.
    void report_lost_docs();

    /// Line break, `;`, `}` or the end of the text.
    bool at_statement_end() const;
    /// True if a block begins here. `system`, `cells`, `stage`, `domain` and `picture` are names
    /// elsewhere.
    bool begins_block(std::size_t ahead = 0) const;
    /// True if `0 = ` begins here.
    bool begins_constraint(std::size_t ahead = 0) const;
    /// True if a statement or a block begins here, in a way that no correct expression contains.
    bool begins_statement(std::size_t ahead = 0) const;
    /// True if the token here is a name with this text.
    bool at_name(std::string_view name, std::size_t ahead = 0) const;

    /// True if an unclosed string lies between `from` and here and contains `swallowed`, which must
    /// not be reported as missing then.
    bool lost_in_text(const Token& from, std::string_view swallowed) const;

    /// Moves to the end of the statement, out of `open_brackets` open brackets and past whole { }.
    void skip_statement(std::size_t open_brackets = 0);

    void error(Span span, std::string message, std::string hint = "");
    void error(Diagnostic diagnostic);
    /// The number of errors in the whole check so far.
    std::size_t error_count() const { return diagnostics_.error_count(); }
    /// Drops errors while true, since the mistake has been reported.
    void mute(bool muted) { muted_ = muted; }

private:
    bool line_ends_statement() const;

    const Sources& sources_;
    Diagnostics& diagnostics_;
    std::vector<Span> docs_;        ///< Doc comments, in order.
    std::vector<bool> docs_taken_;  ///< For each of them.
    std::vector<Token> tokens_;
    std::size_t position_ = 0;
    bool muted_ = false;
};

/// A name for messages, cut if it is long.
std::string shortened(std::string_view name);

/// True if an operand must follow this token, so that a line break after it does not end the
/// statement.
bool wants_operand(TokenKind kind);

}  // namespace cascade
