// Moves over tokens, and finds the end of a statement that has errors.
#include "lang/syntax/token_cursor.h"

#include "lang/syntax/index_words.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

// Messages quote at most this number of bytes of a script.
constexpr std::size_t longest_shown = 40;

}  // namespace

TokenCursor::TokenCursor(SourceId source, const Sources& sources, Diagnostics& diagnostics)
    : sources_(sources),
      diagnostics_(diagnostics),
      tokens_(lex(source, sources, diagnostics, &docs_)) {
    docs_taken_.assign(docs_.size(), false);
}

const Token& TokenCursor::peek(std::size_t ahead) const {
    return tokens_[std::min(position_ + ahead, tokens_.size() - 1)];
}

const Token& TokenCursor::previous() const {
    std::size_t before = position_ == 0 ? 0 : position_ - 1;
    // There are never two line breaks in a row.
    if (before > 0 && tokens_[before].kind == TokenKind::newline) --before;
    return tokens_[before];
}

std::uint32_t TokenCursor::taken_up_to() const {
    if (position_ == 0) return 0;
    const Token& last = tokens_[position_ - 1];
    return position_ == 1 && last.kind == TokenKind::newline ? 0 : last.span.end;
}

Token TokenCursor::take() {
    const Token token = peek();
    if (position_ + 1 < tokens_.size()) ++position_;
    return token;
}

bool TokenCursor::take_if(TokenKind kind) {
    if (!at(kind)) return false;
    take();
    return true;
}

void TokenCursor::step_back() {
    if (position_ > 0) --position_;
}

std::string_view TokenCursor::rest_of_line(const Token& token) const {
    const std::string_view rest = sources_[token.span.source].text().substr(token.span.end);
    return rest.substr(0, rest.find_first_of("\r\n"));
}

std::string TokenCursor::describe(const Token& token) const {
    if (token.kind == TokenKind::newline) return "the end of the line";
    if (token.kind == TokenKind::end_of_text) return "the end of the text";
    const bool is_left_out = token.span.begin == token.span.end;
    const std::string_view word = is_left_out ? token.text : text(token.span);
    const bool is_long_text = token.kind == TokenKind::text && word.size() > longest_shown;
    return is_long_text ? "this text" : "'" + shortened(word) + "'";
}

std::string TokenCursor::take_docs(std::uint32_t begin, std::uint32_t end) {
    constexpr std::string_view white = " \t\r\n";
    std::string joined;
    const auto first =
        std::lower_bound(docs_.begin(), docs_.end(), begin,
                         [](const Span& doc, std::uint32_t offset) { return doc.begin < offset; });
    for (auto doc = first; doc != docs_.end() && doc->begin < end; ++doc) {
        const auto index = static_cast<std::size_t>(doc - docs_.begin());
        if (docs_taken_[index]) continue;
        docs_taken_[index] = true;
        std::string_view words = text(*doc).substr(2);
        words.remove_prefix(std::min(words.find_first_not_of(white), words.size()));
        words = words.substr(0, words.find_last_not_of(white) + 1);
        if (!joined.empty() && !words.empty()) joined += ' ';
        joined += words;
    }
    return joined;
}

void TokenCursor::report_lost_docs() {
    for (std::size_t k = 0; k < docs_.size(); ++k) {
        if (docs_taken_[k]) continue;
        diagnostics_.warning(docs_[k], "this '##' comment describes nothing",
                             "write one '#' for an ordinary comment");
    }
}

bool TokenCursor::at_statement_end() const {
    const TokenKind here = kind();
    return here == TokenKind::newline || here == TokenKind::semicolon ||
           here == TokenKind::close_curly || here == TokenKind::end_of_text;
}

bool TokenCursor::lost_in_text(const Token& from, std::string_view swallowed) const {
    for (std::size_t k = position_; k-- > 0 && tokens_[k].span.begin > from.span.begin;) {
        const bool is_text =
            tokens_[k].kind == TokenKind::garbage && text(tokens_[k]).starts_with('"');
        if (is_text && text(tokens_[k]).find(swallowed) != std::string_view::npos) return true;
    }
    return false;
}

bool TokenCursor::at_name(std::string_view name, std::size_t ahead) const {
    return kind(ahead) == TokenKind::name && text(peek(ahead)) == name;
}

bool TokenCursor::declares(std::string_view name) const {
    if (!declared_) declared_ = declared_names(tokens_);
    return declared_->contains(name);
}

UnitSuffix TokenCursor::unit_here() const {
    if (!at(TokenKind::name) && !at(TokenKind::slash) && !at(TokenKind::number)) return {};
    if (!declared_) declared_ = declared_names(tokens_);
    return unit_suffix(tokens_, position_, *declared_);
}

bool TokenCursor::begins_block(std::size_t ahead) const {
    if (kind(ahead) != TokenKind::name) return false;
    const std::string_view word = text(peek(ahead));
    const TokenKind next = kind(ahead + 1);
    if (word == "system" || word == "stage") {
        if (next == TokenKind::name || next == TokenKind::open_curly) return true;
        // `stage: leopard {` is a block, although the stage's name is missing.
        return next == TokenKind::colon && kind(ahead + 2) == TokenKind::name &&
               kind(ahead + 3) == TokenKind::open_curly;
    }
    if (word == "cells" || word == "shape") {
        // The words `cells` and `shape` may also be names of quantities, as in `cells in 0 .. 1` or
        // `sum(cells over i)`.
        const std::size_t name = next == TokenKind::name ? ahead + 2 : ahead + 1;
        const std::size_t brace = kind(name) == TokenKind::newline ? name + 1 : name;
        if (kind(brace) == TokenKind::open_curly) return true;
        return next == TokenKind::name && kind(name) == TokenKind::colon;
    }
    if (word != "domain" && word != "picture") return false;
    if (next == TokenKind::open_curly) return true;
    const bool has_extra =
        next == TokenKind::newline || next == TokenKind::colon || next == TokenKind::name;
    return has_extra && kind(ahead + 2) == TokenKind::open_curly;
}

bool TokenCursor::begins_constraint(std::size_t ahead) const {
    return kind(ahead) == TokenKind::number && text(peek(ahead)) == "0" &&
           kind(ahead + 1) == TokenKind::assign;
}

bool TokenCursor::begins_statement(std::size_t ahead) const {
    if (begins_constraint(ahead)) return true;
    if (kind(ahead) != TokenKind::name) return false;
    const std::size_t relation =
        after_index([this](std::size_t at) { return kind(at); }, ahead + 1);  // u[i]: …
    const TokenKind next = kind(relation);
    if (next == TokenKind::colon || next == TokenKind::assign) return true;
    if (next == TokenKind::prime) {
        const TokenKind after = kind(relation + 1);
        return after == TokenKind::assign || after == TokenKind::plus_assign;
    }
    return begins_block(ahead);
}

bool TokenCursor::line_ends_statement() const {
    if (begins_statement(1) || kind(1) == TokenKind::close_curly) return true;
    return position_ == 0 || !wants_operand(previous().kind);
}

void TokenCursor::skip_statement(std::size_t open_brackets) {
    std::size_t open_curly = 0;
    for (; !at_end(); take()) {
        switch (kind()) {
            case TokenKind::open_round:
            case TokenKind::open_square: ++open_brackets; break;
            case TokenKind::close_round:
            case TokenKind::close_square:
                if (open_brackets > 0) --open_brackets;
                break;
            case TokenKind::open_curly:
                ++open_curly;
                open_brackets = 0;
                break;
            case TokenKind::close_curly:
                if (open_curly == 0) return;
                --open_curly;
                break;
            case TokenKind::semicolon:
                if (open_curly == 0) return;
                break;
            case TokenKind::newline: {
                if (open_curly > 0 || kind(1) == TokenKind::open_curly) break;
                const bool is_open = open_brackets > 0 && !begins_statement(1);
                if (!is_open && line_ends_statement()) return;
                break;
            }
            default: break;
        }
    }
}

void TokenCursor::error(Span span, std::string message, std::string hint) {
    error(Diagnostic{Severity::error, span, std::move(message), std::move(hint), {}});
}

void TokenCursor::error(Diagnostic diagnostic) {
    if (!muted_) diagnostics_.add(std::move(diagnostic));
}

std::string shortened(std::string_view name) {
    if (name.size() <= longest_shown) return std::string(name);
    return std::string(name.substr(0, longest_shown)) + "…";
}

bool wants_operand(TokenKind kind) {
    switch (kind) {
        case TokenKind::keyword_and:
        case TokenKind::keyword_or:
        case TokenKind::keyword_not:
        case TokenKind::comma:
        case TokenKind::equal:
        case TokenKind::not_equal:
        case TokenKind::less:
        case TokenKind::less_equal:
        case TokenKind::greater:
        case TokenKind::greater_equal:
        case TokenKind::assign:
        case TokenKind::plus_assign:
        case TokenKind::plus:
        case TokenKind::minus:
        case TokenKind::star:
        case TokenKind::slash:
        case TokenKind::caret: return true;
        default: return false;
    }
}

}  // namespace cascade
