// A place in a list of tokens: what the parser of statements and the parser of expressions share.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Walks over the tokens of one source. Never leaves the list: after the end is end_of_text.
class TokenCursor {
public:
    TokenCursor(SourceId source, const Sources& sources, Diagnostics& diagnostics);

    const Token& peek(std::size_t ahead = 0) const;
    TokenKind kind(std::size_t ahead = 0) const { return peek(ahead).kind; }
    bool at(TokenKind kind) const { return peek().kind == kind; }
    bool at_end() const { return at(TokenKind::end_of_text); }
    /// The token taken last that is no line end; the first one before any was taken.
    const Token& previous() const;
    /// Where the token taken last ends, a line end included; 0 where there was none but line ends.
    std::uint32_t taken_up_to() const;
    Token take();
    bool take_if(TokenKind kind);
    /// Back to the token taken last.
    void step_back();
    void skip_newlines() { take_if(TokenKind::newline); }
    /// The same inside brackets: not where the next line begins a statement, since the bracket's
    /// end is missing then.
    void skip_newlines_in_brackets() {
        if (at(TokenKind::newline) && !begins_statement(1)) take();
    }
    std::size_t position() const { return position_; }
    std::size_t token_count() const { return tokens_.size(); }

    std::string_view text(const Token& token) const { return sources_.text(token.span); }
    std::string_view text(Span span) const { return sources_.text(span); }
    ast::Word word(const Token& token) const { return {token.span, text(token)}; }
    /// The token as messages call it: `'beta'`, `the end of the line`. Long ones are cut.
    std::string describe(const Token& token) const;

    /// The text of the doc comments that begin in [begin, end) of the source, joined by blanks,
    /// without those that were taken before.
    std::string take_docs(std::uint32_t begin, std::uint32_t end);
    /// Warns of doc comments that nothing has taken.
    void report_lost_docs();

    /// Line end, `;`, `}` or the end of the text.
    bool at_statement_end() const;
    /// Does a block begin here? `system`, `stage`, `domain` and `picture` are names elsewhere.
    bool begins_block(std::size_t ahead = 0) const;
    /// Is here what begins a statement or a block and has no place in a correct expression?
    bool begins_statement(std::size_t ahead = 0) const;
    /// Is the token here the name with this text?
    bool at_name(std::string_view name, std::size_t ahead = 0) const;

    /// Does a text that is never closed lie between `from` and here, with `swallowed` in it? What
    /// it took with it is not missing.
    bool lost_in_text(const Token& from, std::string_view swallowed) const;

    /// Goes to the end of the statement, over `open_brackets` brackets that are open and over whole
    /// { } with everything in them.
    void skip_statement(std::size_t open_brackets = 0);

    void error(Span span, std::string message, std::string hint = "");
    void error(Diagnostic diagnostic);
    /// Of all that was read so far.
    std::size_t error_count() const { return diagnostics_.error_count(); }
    /// While true, errors are swallowed: the mistake has been told.
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

/// A name as messages show it: cut where it is long.
std::string shortened(std::string_view name);

/// Does an operand have to follow this token, so that a line end after it ends nothing?
bool wants_operand(TokenKind kind);

}  // namespace cascade
