// Finds where a unit after a number begins and ends.
#include "lang/syntax/unit_suffix.h"

#include "lang/vocabulary/units.h"

#include <fmt/format.h>

#include <charconv>

namespace cascade {

namespace {

constexpr int largest_power = 12;

bool touch(const Token& left, const Token& right) { return left.span.end == right.span.begin; }

/// Whether the token begins a statement, or follows `let`.
bool is_declared_here(std::span<const Token> tokens, std::size_t at) {
    if (at == 0) return true;
    const Token& before = tokens[at - 1];
    switch (before.kind) {
        case TokenKind::newline:
        case TokenKind::semicolon:
        case TokenKind::open_curly: return true;
        default: return before.kind == TokenKind::name && before.text == "let";
    }
}

bool is_relation(TokenKind kind) {
    switch (kind) {
        case TokenKind::colon:
        case TokenKind::assign:
        case TokenKind::plus_assign:
        case TokenKind::prime:
        case TokenKind::open_square: return true;
        default: return false;
    }
}

bool is_part_of_unit(TokenKind kind) {
    switch (kind) {
        case TokenKind::name:
        case TokenKind::number:
        case TokenKind::star:
        case TokenKind::slash:
        case TokenKind::caret:
        case TokenKind::minus:
        case TokenKind::superscript: return true;
        default: return false;
    }
}

/// Reads the factors of a unit.
class SuffixReader {
public:
    SuffixReader(std::span<const Token> tokens, std::size_t at,
                 const std::unordered_set<std::string_view>& declared)
        : tokens_(tokens), begin_(at), at_(at), declared_(declared) {}

    UnitSuffix run() {
        if (!read_begin()) return {};
        while (true) {
            found_.text += short_name_of_unit(token(at_).text);
            ++at_;
            if (!read_power() || !read_sign()) break;
        }
        if (!found_.message.empty()) return std::move(found_);
        found_.tokens = at_ - begin_;
        return std::move(found_);
    }

private:
    const Token& token(std::size_t at) const { return tokens_[std::min(at, tokens_.size() - 1)]; }
    TokenKind kind(std::size_t at) const { return token(at).kind; }
    void error(Span span, std::string message, std::string hint) {
        found_.span = span;
        found_.message = std::move(message);
        found_.hint = std::move(hint);
    }

    /// Whether the token at `at` names a unit, and is not a call, a member or the beginning of a
    /// statement.
    bool is_unit(std::size_t at) const {
        if (kind(at) != TokenKind::name || !unit_named(token(at).text)) return false;
        const Token& next = token(at + 1);
        if (next.kind == TokenKind::colon || next.kind == TokenKind::assign ||
            next.kind == TokenKind::prime) {
            return false;
        }
        const bool opens = next.kind == TokenKind::open_round ||
                           next.kind == TokenKind::open_square || next.kind == TokenKind::dot;
        return !(opens && touch(token(at), next));
    }
    bool is_declared(std::size_t at) const { return declared_.contains(token(at).text); }

    /// Moves to the first name of a unit: after the blank, the `/` or the `1/`.
    bool read_begin() {
        if (begin_ == 0 || touch(token(begin_ - 1), token(begin_))) return false;
        const bool is_one = kind(at_) == TokenKind::number && token(at_).text == "1" &&
                            kind(at_ + 1) == TokenKind::slash && touch(token(at_), token(at_ + 1));
        if (is_one) ++at_;
        if (kind(at_) == TokenKind::slash) {
            if (!touch(token(at_), token(at_ + 1))) return false;
            ++at_;
            found_.text = "1/";
        }
        return is_unit(at_) && !is_declared(at_);
    }

    /// Reads `^2` or `^-2`. Returns false after an error.
    bool read_power() {
        if (kind(at_) != TokenKind::caret) return true;
        const bool is_negative = kind(at_ + 1) == TokenKind::minus;
        const std::size_t number = at_ + (is_negative ? 2 : 1);
        const std::string_view digits = token(number).text;
        int power = 0;
        const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), power);
        const bool is_whole = kind(number) == TokenKind::number && result.ec == std::errc() &&
                              result.ptr == digits.data() + digits.size();
        const bool is_apart = !touch(token(at_ - 1), token(at_));
        if (is_apart || !is_whole || power < 1 || power > largest_power) {
            error(is_whole ? join(token(at_ - 1).span, token(number).span) : token(at_).span,
                  "the power of a unit is a whole number from 1 to 12 or from -12 to -1",
                  is_apart ? fmt::format("no blanks: write '{}^{}'", token(at_ - 1).text,
                                         is_whole ? power : 2)
                           : "a root is written (2 m)^0.5");
            return false;
        }
        found_.text += fmt::format("^{}{}", is_negative ? "-" : "", power);
        at_ = number + 1;
        return true;
    }

    /// Reads the sign before the next factor. Returns false if the unit ends here.
    bool read_sign() {
        const Token& sign = token(at_);
        if (sign.kind != TokenKind::star && sign.kind != TokenKind::slash) return false;
        // The product sign may be omitted, as in `m² s⁻¹`.
        const bool is_left_out = sign.span.begin == sign.span.end;
        const bool is_tight =
            is_left_out || (touch(token(at_ - 1), sign) && touch(sign, token(at_ + 1)));
        if (!is_tight || !is_unit(at_ + 1)) return false;
        if (is_declared(at_ + 1)) {
            if (is_left_out) return false;
            const std::string_view name = token(at_ + 1).text;
            error(token(at_ + 1).span,
                  fmt::format("'{}' is a unit, and also a name of this script", name),
                  fmt::format("write ' {} {}' with blanks if the name is meant", sign.text, name));
            return false;
        }
        found_.text += sign.kind == TokenKind::star ? '*' : '/';
        ++at_;
        return true;
    }

    std::span<const Token> tokens_;
    std::size_t begin_, at_;
    const std::unordered_set<std::string_view>& declared_;
    UnitSuffix found_;
};

}  // namespace

std::unordered_set<std::string_view> declared_names(std::span<const Token> tokens) {
    std::unordered_set<std::string_view> declared;
    const auto add = [&](std::size_t at) {
        if (tokens[at].kind == TokenKind::name) declared.insert(tokens[at].text);
    };
    for (std::size_t at = 0; at + 1 < tokens.size(); ++at) {
        if (tokens[at].kind != TokenKind::name) continue;
        if (is_relation(tokens[at + 1].kind) && is_declared_here(tokens, at)) add(at);
        const bool is_function = tokens[at].text == "fn" &&
                                 tokens[at + 1].kind == TokenKind::name && at + 2 < tokens.size() &&
                                 tokens[at + 2].kind == TokenKind::open_round;
        for (std::size_t k = at + 3; is_function && k < tokens.size(); ++k) {
            if (tokens[k].kind == TokenKind::close_round || tokens[k].kind == TokenKind::newline) {
                break;
            }
            add(k);
        }
    }
    return declared;
}

std::string spelling_in_unit(const std::string& spelling, std::string_view name,
                             std::span<const Token> before, std::size_t offset) {
    const bool is_micro = spelling.starts_with("mu") && !name.starts_with('m') &&
                          unit_named("u" + spelling.substr(2));
    for (std::size_t k = before.size(); is_micro && k-- > 0;) {
        const Token& token = before[k];
        // A unit contains no blanks. So if a blank comes before this part, the token before the
        // blank must be a number.
        if (token.span.end != offset) {
            return token.kind == TokenKind::number ? spelling.substr(1) : spelling;
        }
        if (!is_part_of_unit(token.kind)) break;
        offset = token.span.begin;
    }
    return spelling;
}

UnitSuffix unit_suffix(std::span<const Token> tokens, std::size_t at,
                       const std::unordered_set<std::string_view>& declared) {
    return SuffixReader(tokens, at, declared).run();
}

}  // namespace cascade
