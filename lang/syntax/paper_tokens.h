// Reads tokens of the notation of papers. Finds which tokens begin or end an operand, and where
// tokens are in the text. Only for lang/syntax.
#pragma once

#include "lang/syntax/index_words.h"
#include "lang/syntax/paper_notation.h"
#include "lang/syntax/token.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace cascade {

/// Reads tokens from left to right and writes their replacements.
class PaperTokens {
protected:
    PaperTokens(const std::vector<Token>& in, std::string_view text) : in_(in), text_(text) {}

    const Token& token(std::size_t at) const { return in_[std::min(at, in_.size() - 1)]; }
    TokenKind kind(std::size_t at) const { return token(at).kind; }
    bool is_adjacent(std::size_t at) const {
        return at > 0 && token(at - 1).span.end == token(at).span.begin;
    }
    /// The text of the source at a span, for messages.
    std::string_view source(const Span& span) const {
        return text_.substr(span.begin, span.end - span.begin);
    }

    void put(const Token& token) { out_.push_back(token); }
    void put(TokenKind kind, Span span, std::string_view text) {
        out_.push_back({kind, span, text});
    }
    static Span before(const Token& token) {
        return {token.span.source, token.span.begin, token.span.begin};
    }
    static Span after(const Token& token) {
        return {token.span.source, token.span.end, token.span.end};
    }

    bool is_between_operands(std::size_t at) const {
        return kind(at) == TokenKind::name && at > 0 && is_word_between_operands(token(at).text) &&
               ends_operand(at - 1);
    }
    bool ends_operand(std::size_t at) const {
        switch (kind(at)) {
            case TokenKind::name: return !is_between_operands(at);
            case TokenKind::number:
            case TokenKind::close_round:
            case TokenKind::close_square:
            case TokenKind::prime: return true;
            // True if the superscript is a power. The ² of ∇² is not.
            case TokenKind::superscript: return at == power_end_;
            default: return false;
        }
    }
    bool begins_statement(std::size_t at) const {
        std::size_t relation =
            after_index([this](std::size_t ahead) { return kind(ahead); }, at + 1);
        while (kind(relation) == TokenKind::prime) ++relation;
        return kind(relation) == TokenKind::colon || kind(relation) == TokenKind::assign ||
               kind(relation) == TokenKind::plus_assign;
    }
    bool begins_operand(std::size_t at) const {
        switch (kind(at)) {
            case TokenKind::name:
            case TokenKind::number:
            case TokenKind::open_round:
            case TokenKind::open_square:
            case TokenKind::nabla:
            case TokenKind::laplacian:
            case TokenKind::root: return true;
            default: return false;
        }
    }
    bool is_after_power() const { return at_ > 0 && power_end_ == at_ - 1; }
    bool is_after_application() const { return at_ > 0 && application_end_ == at_ - 1; }

    static bool is_width(const Token& token) {
        return token.kind == TokenKind::name &&
               (token.text == "x" || token.text == "y" || token.text == "z" || token.text == "t");
    }
    /// The position after the `]` that closes the `[` at `open` on the same line.
    std::size_t end_of_index(std::size_t open) const {
        std::size_t depth = 0;
        for (std::size_t at = open; at < in_.size(); ++at) {
            if (kind(at) == TokenKind::newline) break;
            if (kind(at) == TokenKind::open_square) ++depth;
            if (kind(at) == TokenKind::close_square && --depth == 0) return at + 1;
        }
        return open;
    }
    /// The axis of a derivative: x if the tokens from `slash` on are `/∂x`. Empty for other tokens.
    std::string_view axis_of(std::size_t slash) const {
        const bool is_there = kind(slash) == TokenKind::slash &&
                              kind(slash + 1) == TokenKind::partial && is_width(token(slash + 2));
        return is_there ? token(slash + 2).text : std::string_view();
    }
    /// The second axis of a derivative: y in `/∂x∂y`, x in `/∂x²`. Empty if there is no second
    /// axis.
    std::string_view second_axis(std::size_t slash, std::string_view axis) const {
        const Token& next = token(slash + 3);
        if (next.kind == TokenKind::superscript && source(next.span) == "²") return axis;
        const bool is_mixed = next.kind == TokenKind::partial && is_width(token(slash + 4));
        return is_mixed ? token(slash + 4).text : std::string_view();
    }

    static constexpr std::size_t no_token = ~std::size_t{0};

    const std::vector<Token>& in_;
    std::string_view text_;
    std::vector<Token> out_;
    std::size_t at_ = 0;
    std::size_t power_end_ = no_token;  ///< The position of the last superscript that is a power.
    /// The position of the last token of the last operator with its operand.
    std::size_t application_end_ = no_token;
};

}  // namespace cascade
