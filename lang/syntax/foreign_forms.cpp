// Describes comments and numbers as other languages write them. Decides by the text and the tokens
// around the comment or number.
#include "lang/syntax/foreign_forms.h"

#include "core/decimal.h"
#include "lang/vocabulary/greek_letters.h"
#include "lang/vocabulary/signs_elsewhere.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace cascade {

namespace {

template <std::size_t count>
bool is_one_of(std::string_view word, const std::array<std::string_view, count>& words) {
    return std::ranges::find(words, word) != words.end();
}

/// Whether a name is expected after these tokens, as after `system` and `stage a:`.
bool is_name_expected(std::span<const Token> before) {
    static constexpr std::array<std::string_view, 6> keywords = {"system", "cells", "shape",
                                                                 "stage",  "let",   "fn"};
    if (before.empty()) return false;
    const bool is_base = before.back().kind == TokenKind::colon && before.size() > 2 &&
                         before[before.size() - 2].kind == TokenKind::name;
    const Token& keyword = is_base ? before[before.size() - 3] : before.back();
    return keyword.kind == TokenKind::name && is_one_of(keyword.text, keywords);
}

/// Whether these tokens begin the value of a setting that must be a whole number, such as `cells: `
/// or `grid: 64, `.
bool is_count_expected(std::span<const Token> before) {
    static constexpr std::array<std::string_view, 7> counts = {"iterations", "interval", "cells",
                                                               "grid",       "founders", "check",
                                                               "seed"};
    while (!before.empty() &&
           (before.back().kind == TokenKind::comma || before.back().kind == TokenKind::number)) {
        before = before.first(before.size() - 1);
    }
    return before.size() > 1 && before.back().kind == TokenKind::colon &&
           is_one_of(before[before.size() - 2].text, counts);
}

double value_of_digits(std::string_view digits) {
    double value = 0;
    from_decimal(digits.data(), digits.data() + digits.size(), value);
    return value;
}

/// The position after the power in `x10^-3` or `x10^(-3)`. `caret` is the position of the '^'.
/// nullopt if no power follows.
std::optional<std::size_t> end_of_power(std::string_view text, std::size_t caret) {
    std::size_t at = caret + 1;
    const auto here = [&] { return at < text.size() ? text[at] : '\0'; };
    const bool has_bracket = here() == '(';
    if (has_bracket) ++at;
    if (here() == '-' || here() == '+') ++at;
    const std::size_t digits = at;
    while (is_digit(here())) ++at;
    if (at == digits || (has_bracket && here() != ')')) return std::nullopt;
    return has_bracket ? at + 1 : at;
}

}  // namespace

bool begins_foreign_comment(std::string_view text, std::size_t offset) {
    const std::string_view here = text.substr(offset);
    if (here.starts_with("//") || here.starts_with("/*")) return true;
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n'; };
    return here.starts_with("--") && (offset == 0 || is_blank(text[offset - 1])) &&
           here.size() > 2 && is_blank(here[2]);
}

NumberFault fault_of_number(std::span<const Token> before, std::string_view text, std::size_t begin,
                            std::size_t number_end, std::size_t end) {
    constexpr std::size_t longest = 40;
    const std::string_view word = text.substr(begin, std::min(end - begin, longest));
    const std::string_view number = text.substr(begin, number_end - begin);
    const std::string_view tail = text.substr(number_end, end - number_end);
    if (is_name_expected(before) && word.find('.') == std::string_view::npos) {
        return {fmt::format("'{}' is not a name", word),
                fmt::format("names begin with a letter or '_': write '_{}'", word), end};
    }
    const bool is_power = (tail == "x10" || tail == "X10") && end < text.size() && text[end] == '^';
    if (const auto whole = is_power ? end_of_power(text, end) : std::nullopt) {
        std::string power(text.substr(end + 1, *whole - end - 1));
        std::erase_if(power, [](char c) { return c == '(' || c == ')' || c == '+'; });
        return {fmt::format("'{:.40}' is not a number", text.substr(begin, *whole - begin)),
                fmt::format("write '{}e{}'", number, power), *whole};
    }
    const double times = tail == "k" || tail == "K" ? 1e3 : tail == "M" ? 1e6 : 0;
    if (times > 0 && is_count_expected(before)) {
        const std::string value = fmt::format("{:.15g}", times * value_of_digits(number));
        return {fmt::format("'{}' is not a number", word), fmt::format("write '{}'", value), end};
    }
    return {fmt::format("'{}' is not a number", word), advice_about_number(number, tail), end};
}

}  // namespace cascade
