// Finds the words of a script, and decides between which words there is a blank.
#include "lang/format/format_words.h"

#include "core/utf8.h"
#include "lang/syntax/paper_notation.h"
#include "lang/syntax/unit_suffix.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr std::size_t tab_width = 8;

/// Collects tokens, and divides the text between two tokens into comments.
class WordList {
public:
    explicit WordList(std::string_view text) : text_(text) {
        if (text.starts_with("\xef\xbb\xbf")) offset_ = 3;  // Skips the byte order mark.
    }

    void add_token(const Token& token) {
        pass_over_gap(token.span.begin);
        add(token.kind, text_.substr(token.span.begin, token.span.end - token.span.begin));
        words_.back().spelling = token.text;
        words_.back().gap = next_gap_;
        next_gap_.reset();
    }
    /// Sets the numbers of blanks before the last word and before the next word.
    void set_gaps(std::size_t before, std::size_t after) {
        words_.back().gap = before;
        next_gap_ = after;
    }
    /// Adds the comments between the last word and `end`, and skips line breaks and blanks.
    void pass_over_gap(std::size_t end) {
        while (offset_ < end) {
            const char c = text_[offset_];
            if (c == '#') {
                add_comment();
            } else if (c == '\n' || c == '\r') {
                offset_ += text_.substr(offset_).starts_with("\r\n") ? 2 : 1;
                ++breaks_;
                column_ = 0;
                blanks_ = 0;
            } else {
                const std::size_t step = c == '\t' ? tab_width - column_ % tab_width : 1;
                column_ += step;
                blanks_ += step;
                ++offset_;
            }
        }
    }
    std::vector<FormatWord> take() { return std::move(words_); }

private:
    void add_comment() {
        const std::size_t end = std::min(text_.find_first_of("\r\n", offset_), text_.size());
        std::string_view comment = text_.substr(offset_, end - offset_);
        comment = comment.substr(0, comment.find_last_not_of(" \t") + 1);
        add(TokenKind::newline, comment);
        offset_ = end;
    }
    void add(TokenKind kind, std::string_view text) {
        FormatWord word;
        word.kind = kind;
        word.text = text;
        word.breaks = breaks_;
        word.blanks = blanks_;
        word.column = column_;
        words_.push_back(word);
        breaks_ = 0;
        blanks_ = 0;
        column_ += width_of(text);
        offset_ += text.size();
    }

    std::string_view text_;
    std::size_t offset_ = 0;
    std::size_t breaks_ = 0;
    std::size_t blanks_ = 0;
    std::size_t column_ = 0;
    std::optional<std::size_t> next_gap_;
    std::vector<FormatWord> words_;
};

bool ends_operand(TokenKind kind) {
    return kind == TokenKind::name || kind == TokenKind::number || kind == TokenKind::text ||
           kind == TokenKind::prime || kind == TokenKind::close_round ||
           kind == TokenKind::close_square;
}

/// Whether the author's blanks around an operator stay, because they show which operands belong
/// together: `a*b + 1/8`, `1..n`.
bool is_author_spaced(const FormatWord& word) {
    return word.kind == TokenKind::star || word.kind == TokenKind::slash ||
           word.kind == TokenKind::dots;
}

bool is_apart(const FormatWord& word) { return word.blanks > 0 || word.breaks > 0; }

/// Decides which words are signs, infix names, or operators with blanks around them, from the words
/// before and after each word.
void find_roles(std::vector<FormatWord>& words) {
    const FormatWord* before = nullptr;  // The last word that is not a comment.
    FormatWord* waiting = nullptr;  // The previous word, if it is an operator whose blanks stay.
    for (FormatWord& word : words) {
        if (waiting != nullptr) waiting->is_spaced = waiting->is_spaced || is_apart(word);
        waiting = nullptr;
        if (word.is_comment()) continue;
        const bool follows_operand =
            before != nullptr && ends_operand(before->kind) && !before->is_infix;
        word.is_sign = word.kind == TokenKind::minus && !follows_operand;
        word.is_infix = follows_operand && word.kind == TokenKind::name &&
                        is_word_between_operands(word.spelling);
        if (is_author_spaced(word)) {
            word.is_spaced = is_apart(word);
            waiting = &word;
        }
        before = &word;
    }
}

}  // namespace

std::size_t width_of(std::string_view text) {
    std::size_t width = 0;
    for (std::size_t offset = 0; offset < text.size();) {
        const CodePoint point = decode_utf8(text, offset);
        width += static_cast<std::size_t>(std::max(display_width(point.value), 0));
        offset += point.size;
    }
    return width;
}

std::vector<FormatWord> format_words(SourceId source, const Sources& sources) {
    Diagnostics already_reported;
    const std::string_view text = sources[source].text();
    WordList list(text);
    const std::vector<Token> tokens = lex(source, sources, already_reported);
    const auto declared = declared_names(tokens);
    for (std::size_t k = 0; k < tokens.size(); ++k) {
        const Token& token = tokens[k];
        if (token.kind == TokenKind::newline) continue;
        if (token.kind == TokenKind::end_of_text) list.pass_over_gap(text.size());
        else list.add_token(token);
        const bool begins_unit = token.kind == TokenKind::slash && k > 0 &&
                                 tokens[k - 1].kind == TokenKind::number &&
                                 unit_suffix(tokens, k, declared).tokens > 0;
        if (begins_unit) list.set_gaps(1, 0);
    }
    std::vector<FormatWord> words = list.take();
    find_roles(words);
    return words;
}

std::size_t blanks_between(const FormatWord& left, const FormatWord& right) {
    using Kind = TokenKind;
    if (right.gap) return *right.gap;
    if (left.is_sign)
        // Two signs are separated, because `--` is not an operator.
        return right.is_sign ? 1 : 0;
    switch (right.kind) {
        case Kind::comma:
        case Kind::semicolon:
        case Kind::colon:
        case Kind::close_round:
        case Kind::close_square:
        case Kind::dot:
        case Kind::prime:
        case Kind::caret: return 0;
        case Kind::star:
        case Kind::slash: return right.is_spaced ? 1 : 0;
        default: break;
    }
    switch (left.kind) {
        case Kind::open_round:
        case Kind::open_square:
        case Kind::dot:
        case Kind::caret: return 0;

        case Kind::star:
        case Kind::slash: return left.is_spaced ? 1 : 0;
        default: break;
    }
    if (right.kind == Kind::dots) return right.is_spaced ? 1 : 0;
    if (left.kind == Kind::dots) return left.is_spaced ? 1 : 0;
    if (right.kind == Kind::open_round) return left.kind == Kind::name && !left.is_infix ? 0 : 1;
    if (right.kind == Kind::open_square && left.kind == Kind::name) {
        return is_apart(right) ? 1 : 0;  // Without a blank, u[i] is a member of a family.
    }
    return 1;
}

}  // namespace cascade
