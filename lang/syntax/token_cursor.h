// A position in a list of tokens. The parsers of statements and of expressions share it.
#pragma once

#include "core/diagnostics.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"
#include "lang/syntax/unit_suffix.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace cascade {

/// Moves over the tokens of one source, but never beyond end_of_text.
class TokenCursor {
public:
    TokenCursor(SourceId source, const Sources& sources, Diagnostics& diagnostics);

    const Token& peek(std::size_t ahead = 0) const;
    TokenKind kind(std::size_t ahead = 0) const { return peek(ahead).kind; }
    bool at(TokenKind kind) const { return peek().kind == kind; }
    bool at_end() const { return at(TokenKind::end_of_text); }
    /// The last token that was taken and is not a line break. If there is none, the first token.
    const Token& previous() const;
    /// The token `count` places before the present token. Line breaks count, too. If there are
    /// fewer tokens before the present one, the first token.
    const Token& behind(std::size_t count) const {
        return tokens_[position_ < count ? 0 : position_ - count];
    }
    /// The position at which the last taken token ends, even if this token is a line break. 0 if
    /// only line breaks were taken.
    std::uint32_t taken_up_to() const;
    Token take();
    bool take_if(TokenKind kind);
    /// Moves back to the token that was taken last.
    void step_back();
    void skip_newlines() { take_if(TokenKind::newline); }
    /// Skips line breaks inside brackets. Stops before a line that begins a statement, because then
    /// the closing bracket is missing.
    void skip_newlines_in_brackets() {
        if (at(TokenKind::newline) && !begins_statement(1)) take();
    }
    std::size_t position() const { return position_; }
    std::size_t token_count() const { return tokens_.size(); }

    /// The text of the token for the parser. In a script without errors, this text is ASCII.
    std::string_view text(const Token& token) const { return token.text; }
    std::string_view text(Span span) const { return sources_.text(span); }
    /// The rest of the line after the token, including comments.
    std::string_view rest_of_line(const Token& token) const;
    ast::Word word(const Token& token) const { return {token.span, text(token)}; }
    /// Describes the token for messages: `'beta'`, `the end of the line`. Long names are cut.
    std::string describe(const Token& token) const;

    /// The text of the doc comments that begin in [begin, end) of the source, joined by blanks.
    /// Leaves out comments that an earlier call has taken.
    std::string take_docs(std::uint32_t begin, std::uint32_t end);
    /// Warns of doc comments that no call has taken.
    void report_lost_docs();

    /// Whether the present token is a line break, `;`, `}` or the end of the text.
    bool at_statement_end() const;
    /// Whether a block begins at the cursor. In other places, `system`, `cells`, `stage`, `domain`
    /// and `picture` are names.
    bool begins_block(std::size_t ahead = 0) const;
    /// Whether `0 = ` begins at the cursor.
    bool begins_constraint(std::size_t ahead = 0) const;
    /// Whether a statement or a block begins at the cursor. Recognises both by tokens that no
    /// correct expression contains.
    bool begins_statement(std::size_t ahead = 0) const;
    /// Whether the present token is a name with this text.
    bool at_name(std::string_view name, std::size_t ahead = 0) const;

    /// The unit that begins at the cursor, directly after a number.
    UnitSuffix unit_here() const;
    /// Whether the script declares this name (lang/syntax/unit_suffix.h).
    bool declares(std::string_view name) const;

    /// Whether an unclosed string between `from` and the cursor contains `swallowed`. If so,
    /// `swallowed` must not be reported as missing.
    bool lost_in_text(const Token& from, std::string_view swallowed) const;

    /// Moves to the end of the statement, and skips whole blocks { } on the way. `open_brackets` is
    /// the number of brackets that are open at the cursor.
    void skip_statement(std::size_t open_brackets = 0);

    void error(Span span, std::string message, std::string hint = "");
    void error(Diagnostic diagnostic);
    /// The number of errors reported so far.
    std::size_t error_count() const { return diagnostics_.error_count(); }
    /// Mutes or unmutes the cursor. A muted cursor drops errors, because the mistake has already
    /// been reported.
    void mute(bool muted) { muted_ = muted; }

private:
    bool line_ends_statement() const;

    const Sources& sources_;
    Diagnostics& diagnostics_;
    std::vector<Span> docs_;        ///< The locations of doc comments, in order.
    std::vector<bool> docs_taken_;  ///< For each doc comment, whether it was taken.
    std::vector<Token> tokens_;
    std::size_t position_ = 0;
    /// The result of declared_names() for the tokens, once it has been needed.
    mutable std::optional<std::unordered_set<std::string_view>> declared_;
    bool muted_ = false;
};

/// A name as messages show it. Long names are cut.
std::string shortened(std::string_view name);

/// Whether an operand must follow this token. A line break after such a token does not end the
/// statement.
bool wants_operand(TokenKind kind);

}  // namespace cascade
