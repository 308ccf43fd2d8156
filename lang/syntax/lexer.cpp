// Splits a source into tokens in one pass over its bytes.
#include "core/utf8.h"
#include "lang/syntax/bars.h"
#include "lang/syntax/foreign_forms.h"
#include "lang/syntax/kept_spellings.h"
#include "lang/syntax/look_alikes.h"
#include "lang/syntax/operator_spellings.h"
#include "lang/syntax/paper_notation.h"
#include "lang/syntax/token.h"
#include "lang/syntax/unit_suffix.h"
#include "lang/syntax/unreadable_bytes.h"
#include "lang/vocabulary/greek_letters.h"
#include "lang/vocabulary/signs_elsewhere.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace cascade {

namespace {

bool is_name_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name_part(char c) { return is_name_start(c) || is_digit(c); }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// A letter or digit in a name, and its spelling in ASCII.
struct NamePart {
    std::uint32_t size = 0;  ///< The number of bytes in the text.
    std::string_view spelling;
};

class Lexer {
public:
    Lexer(SourceId source, const Sources& sources, Diagnostics& diagnostics,
          std::vector<Span>* docs)
        : source_(source), text_(sources[source].text()), diagnostics_(diagnostics), docs_(docs) {}

    std::vector<Token> run() {
        report_unreadable_bytes(source_, text_, diagnostics_);
        if (text_.starts_with("\xef\xbb\xbf")) offset_ = 3;  // Skips the byte order mark.
        while (offset_ < text_.size()) {
            if (tokens_.size() == most_tokens) {
                tokens_.clear();
                diagnostics_.error(span(0, 0),
                                   fmt::format("this script has more than {} words", most_tokens));
                break;
            }
            read_token();
        }
        const auto end = static_cast<std::uint32_t>(text_.size());
        tokens_.push_back({TokenKind::end_of_text, {source_, end, end}});
        if (!has_signs_of_papers_) return std::move(tokens_);
        return without_paper_notation(without_bars(tokens_, diagnostics_), text_, diagnostics_);
    }

private:
    char at(std::size_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }
    Span span(std::size_t begin, std::size_t end) const {
        return {source_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
    }
    /// Adds a token for the text [begin, end) and moves to `end`.
    void push(TokenKind kind, std::size_t begin, std::size_t end) {
        push(kind, begin, end, text_.substr(begin, end - begin));
    }
    void push(TokenKind kind, std::size_t begin, std::size_t end, std::string_view text) {
        tokens_.push_back({kind, span(begin, end), text});
        offset_ = end;
    }

    bool begins_operator(std::size_t offset) const;
    bool joins_a_name(std::size_t offset) const;
    NamePart name_part(std::size_t offset) const;

    void read_token();
    void read_line_end();
    void skip_line() {
        while (offset_ < text_.size() && !is_line_end(text_[offset_])) ++offset_;
    }
    void skip_comment();
    void skip_foreign_comment();
    void read_name();
    void read_bad_name(std::size_t begin);
    void read_number();
    void read_text(std::size_t quote_size, std::string_view closing);
    bool read_superscript();
    bool read_operator();
    bool read_foreign(const ForeignOperator& foreign);
    void read_look_alike(const LookAlike& look_alike);
    void read_other();

    SourceId source_;
    std::string_view text_;
    Diagnostics& diagnostics_;
    std::vector<Span>* docs_;
    std::vector<Token> tokens_;
    std::size_t offset_ = 0;
    bool has_signs_of_papers_ = false;  ///< Whether the tokens need without_paper_notation().
};

bool Lexer::begins_operator(std::size_t offset) const {
    const std::string_view rest = text_.substr(offset);
    return std::any_of(std::begin(operators), std::end(operators),
                       [&](const Operator& known) { return rest.starts_with(known.spelling); });
}

/// Whether the character at `offset` is outside of ASCII but resembles a letter, so that it is
/// probably meant to be a part of the name.
bool Lexer::joins_a_name(std::size_t offset) const {
    if (offset >= text_.size() || static_cast<unsigned char>(text_[offset]) < 0x80) return false;
    const CodePoint point = decode_utf8(text_, offset);
    return point.valid && !is_unprintable(point.value) && !find_look_alike(point.value) &&
           !superscript_digit(point.value) && !begins_operator(offset);
}

/// The letter or digit of a name that is at `offset`. The size is 0 if another character is at
/// `offset`.
NamePart Lexer::name_part(std::size_t offset) const {
    if (is_name_part(at(offset))) return {1, text_.substr(offset, 1)};
    if (offset >= text_.size() || static_cast<unsigned char>(text_[offset]) < 0x80) return {};
    const CodePoint point = decode_utf8(text_, offset);
    if (!point.valid) return {};
    if (const auto digit = subscript_digit(point.value)) {
        const auto at = static_cast<std::size_t>(*digit - '0');
        return {point.size, std::string_view("0123456789").substr(at, 1)};
    }
    const std::string_view spelling = greek_spelling(point.value);
    return {spelling.empty() ? 0 : point.size, spelling};
}

void Lexer::read_token() {
    const char c = text_[offset_];
    if (c == ' ' || c == '\t') {
        ++offset_;
    } else if (is_line_end(c)) {
        read_line_end();
    } else if (c == '#') {
        skip_comment();
    } else if (is_name_start(c)) {
        read_name();
    } else if (is_digit(c) || (c == '.' && is_digit(at(offset_ + 1)))) {
        read_number();
    } else if (c == '"') {
        read_text(1, "\"");
    } else if (begins_foreign_comment(text_, offset_)) {
        skip_foreign_comment();
    } else if (!read_operator()) {
        read_other();
    }
}

/// Reads a line end. Several line breaks in a row become one token, even with blanks and comments
/// between them.
void Lexer::read_line_end() {
    const std::size_t size = text_.substr(offset_).starts_with("\r\n") ? 2 : 1;
    if (!tokens_.empty() && tokens_.back().kind == TokenKind::newline) {
        offset_ += size;
    } else {
        push(TokenKind::newline, offset_, offset_ + size);
    }
}

void Lexer::skip_comment() {
    const std::size_t begin = offset_;
    skip_line();
    const bool is_doc = at(begin + 1) == '#' && at(begin + 2) != '#';
    if (docs_ != nullptr && is_doc) docs_->push_back(span(begin, offset_));
}

void Lexer::skip_foreign_comment() {
    diagnostics_.error(span(offset_, offset_ + 2), "a comment begins with '#'", "write '#'");
    const bool is_block = at(offset_ + 1) == '*';
    const std::size_t end = is_block ? text_.find("*/", offset_ + 2) : std::string_view::npos;
    if (end == std::string_view::npos) {
        skip_line();
    } else {
        offset_ = end + 2;
    }
}

void Lexer::read_name() {
    std::size_t end = offset_;
    std::string spelling;
    for (NamePart part = name_part(end); part.size > 0; part = name_part(end)) {
        spelling += part.spelling;
        end += part.size;
    }
    if (joins_a_name(end)) return read_bad_name(offset_);
    const std::string_view name = text_.substr(offset_, end - offset_);
    if (name != spelling) spelling = spelling_in_unit(spelling, name, tokens_, offset_);
    if (name != spelling) return push(TokenKind::name, offset_, end, kept_spelling(spelling));
    TokenKind kind = TokenKind::name;
    if (name == "and") kind = TokenKind::keyword_and;
    if (name == "or") kind = TokenKind::keyword_or;
    if (name == "not") kind = TokenKind::keyword_not;
    push(kind, offset_, end);
}

/// Reports a name with letters of another alphabet.
void Lexer::read_bad_name(std::size_t begin) {
    std::string latin, first_wrong;
    bool has_spelling = true, is_marked = false, is_dotted = false;
    std::size_t end = begin;
    while (true) {
        const NamePart part = name_part(end);
        if (part.size == 0 && !joins_a_name(end)) break;
        if (part.size > 0) {
            latin += part.spelling;
            end += part.size;
            continue;
        }
        const CodePoint point = decode_utf8(text_, end);
        const std::string_view letter = text_.substr(end, point.size);
        end += point.size;
        const bool is_mark = display_width(point.value) == 0;
        if (first_wrong.empty()) {
            const auto number = static_cast<std::uint32_t>(point.value);
            first_wrong = is_mark ? fmt::format("the mark U+{:04X} above or below a letter", number)
                                  : fmt::format("'{}' (U+{:04X})", letter, number);
            is_marked = is_mark;
            is_dotted = point.value == U'\u0307';
        }
        if (is_mark) continue;
        has_spelling = has_spelling && !latin_spelling(point.value).empty();
        latin += latin_spelling(point.value);
    }
    has_spelling = has_spelling && end - begin <= 64;
    std::string hint = has_spelling ? "write '" + latin + "'"
                                    : "names are of a to z, A to Z, 0 to 9, Greek letters and _";
    if (has_spelling && is_dotted) hint = "write " + latin + "' for a rate";
    diagnostics_.error(span(begin, end),
                       first_wrong +
                           (is_marked ? " cannot be part of a name" : " is not a letter of a name"),
                       std::move(hint));
    push(TokenKind::garbage, begin, end);
}

void Lexer::read_number() {
    const std::size_t begin = offset_;
    std::size_t end = begin;
    while (is_digit(at(end))) ++end;
    if (at(end) == '.' && at(end + 1) != '.') ++end;  // Two dots are a range, as in 1..3.
    while (is_digit(at(end))) ++end;
    if (at(end) == 'e' || at(end) == 'E') {
        const std::size_t sign = at(end + 1) == '+' || at(end + 1) == '-' ? 1 : 0;
        if (is_digit(at(end + 1 + sign))) {
            end += 1 + sign;
            while (is_digit(at(end))) ++end;
        }
    }
    const std::size_t number_end = end;
    while (name_part(end).size > 0 || (at(end) == '.' && is_digit(at(end + 1)))) {
        end += std::max(name_part(end).size, 1u);
    }
    if (end == number_end) return push(TokenKind::number, begin, end);
    const NumberFault fault = fault_of_number(tokens_, text_, begin, number_end, end);
    diagnostics_.error(span(begin, fault.end), fault.message, fault.hint);
    push(TokenKind::garbage, begin, fault.end);
}

/// Reads a string, which must end on the same line. If the string has other quotation marks than
/// '"' or contains unreadable bytes, it becomes garbage. Both errors are reported elsewhere.
void Lexer::read_text(std::size_t quote_size, std::string_view closing) {
    const std::size_t begin = offset_;
    bool readable = quote_size == 1;
    std::size_t end = begin + quote_size;
    while (end < text_.size() && !is_line_end(text_[end])) {
        if (text_.substr(end).starts_with(closing)) {
            end += closing.size();
            return push(readable ? TokenKind::text : TokenKind::garbage, begin, end);
        }
        readable = readable && !is_unreadable(text_, end);
        end += decode_utf8(text_, end).size;
    }
    if (quote_size == 1) {
        diagnostics_.error(span(begin, end), "this text is never closed",
                           "a text ends with '\"' on its line");
    }
    push(TokenKind::garbage, begin, end);
}

/// Reads superscript digits, which may begin with a superscript minus.
bool Lexer::read_superscript() {
    std::size_t end = offset_;
    while (end < text_.size()) {
        const CodePoint point = decode_utf8(text_, end);
        if (!superscript_digit(point.value) || (end > offset_ && point.value == U'⁻')) break;
        end += point.size;
    }
    if (end == offset_) return false;
    push(TokenKind::superscript, offset_, end);
    has_signs_of_papers_ = true;
    return true;
}

bool Lexer::read_operator() {
    const std::string_view rest = text_.substr(offset_);
    for (const ForeignOperator& foreign : foreign_operators) {
        if (rest.starts_with(foreign.spelling)) return read_foreign(foreign);
    }
    for (const Operator& known : operators) {
        if (rest.starts_with(known.spelling)) {
            push(known.kind, offset_, offset_ + known.spelling.size(), spelling(known.kind));
            has_signs_of_papers_ = has_signs_of_papers_ || is_sign_of_papers(known.kind) ||
                                   known.kind == TokenKind::bar;
            return true;
        }
    }
    return rest.starts_with('!') && read_foreign(foreign_not);
}

bool Lexer::read_foreign(const ForeignOperator& foreign) {
    const std::size_t end = offset_ + foreign.spelling.size();
    diagnostics_.error(span(offset_, end),
                       fmt::format("'{}' is not an operator of the language", foreign.spelling),
                       std::string(foreign.hint));
    push(foreign.meant, offset_, end);
    return true;
}

void Lexer::read_look_alike(const LookAlike& look_alike) {
    const std::size_t begin = offset_;
    const CodePoint point = decode_utf8(text_, begin);
    const std::string_view letter = text_.substr(begin, point.size);
    const auto number = static_cast<std::uint32_t>(point.value);
    // Adjacent blanks of the same kind are reported together.
    if (look_alike.meant == TokenKind::newline) {
        while (text_.substr(offset_).starts_with(letter)) offset_ += letter.size();
        diagnostics_.error(span(begin, offset_),
                           fmt::format("U+{:04X} is not an ordinary space", number),
                           "write a plain blank");
        return;
    }
    const bool is_power = look_alike.meant == TokenKind::garbage;
    diagnostics_.error(
        span(begin, begin + point.size),
        fmt::format("'{}' (U+{:04X}) has no meaning in the language", letter, number),
        look_alike.meant == TokenKind::prime ? "write the apostrophe '"
                                             : fmt::format("write '{}'", look_alike.write));
    if (look_alike.meant == TokenKind::text) {
        const std::string_view closing = point.value == U'\u201e' ? "\u201c" : "\u201d";
        const bool is_guillemet = point.value == U'\u00ab';
        return read_text(point.size, is_guillemet ? "\u00bb" : closing);
    }
    if (is_power) {  // The power is skipped, and the parser continues without it.
        offset_ += point.size;
        return;
    }
    push(look_alike.meant, begin, begin + point.size);
}

/// Reads any character that begins neither a name nor a number nor an operator.
void Lexer::read_other() {
    const std::size_t begin = offset_;
    std::size_t end = begin;
    while (end < text_.size() && is_unreadable(text_, end)) ++end;
    if (end > begin)
        // An error has already been reported.
        return push(TokenKind::garbage, begin, end);
    const CodePoint point = decode_utf8(text_, begin);
    if (!greek_spelling(point.value).empty()) return read_name();
    if (read_superscript()) return;
    if (const LookAlike* look_alike = find_look_alike(point.value)) {
        return read_look_alike(*look_alike);
    }
    if (joins_a_name(begin)) return read_bad_name(begin);
    if (is_unprintable(point.value)) {
        end = begin + point.size;
        diagnostics_.error(span(begin, end),
                           fmt::format("U+{:04X} is an invisible character without a meaning here",
                                       static_cast<std::uint32_t>(point.value)),
                           "take it out");
        return push(TokenKind::garbage, begin, end);
    }
    while (end < text_.size() && text_[end] == text_[begin]) ++end;
    std::string hint;
    if (text_[begin] == '?') hint = "a choice is written if(condition, a, b)";
    if (text_[begin] == '`') hint = "write ' for a rate";
    if (text_[begin] == '$') hint = "formulas have no '$'; leave it out";
    if (text_[begin] == '\\') {
        const LatexText found = latex_text(text_.substr(end));
        end += found.size;
        hint = found.advice;
    }
    const std::string_view run = text_.substr(begin, std::min<std::size_t>(end - begin, 16));
    diagnostics_.error(span(begin, end), fmt::format("'{}' has no meaning in the language", run),
                       hint);
    push(TokenKind::garbage, begin, end);
}

}  // namespace

std::vector<Token> lex(SourceId source, const Sources& sources, Diagnostics& diagnostics,
                       std::vector<Span>* docs) {
    return Lexer(source, sources, diagnostics, docs).run();
}

}  // namespace cascade
