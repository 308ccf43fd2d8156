// Divides a formula into numbers, names and signs.
#include "import/formula_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cascade::importing {

namespace {

bool is_letter_of_name(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_';
}
bool is_decimal_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// The signs of all dialects, longer ones first, with their meanings.
constexpr std::pair<std::string_view, std::string_view> foreign_signs[] = {
    {"&amp;&amp;", "and"}, {"&lt;=", "<="}, {"&gt;=", ">="}, {"&lt;", "<"}, {"&gt;", ">"},
    {"**", "**"},          {"+=", "+="},    {"-=", "-="},    {"*=", "*="},  {"/=", "/="},
    {"++", "++"},          {"--", "--"},    {"==", "=="},    {"!=", "!="},  {"<=", "<="},
    {">=", ">="},          {"&&", "and"},   {"||", "or"},    {"&", "and"},  {"|", "or"},
};
constexpr std::string_view single_signs = "+-*/%^<>=!?:;,(){}[].'";

class WordReader {
public:
    WordReader(Span span, std::string_view text, const Dialect& dialect)
        : span_(span), text_(text), dialect_(dialect) {}

    /// The next word. At the end of the text, its kind is `end`. If no word begins with the next
    /// letter, its kind is `end`, too, and its text describes the error.
    FormulaWord next() {
        skip();
        FormulaWord word;
        if (at_ == text_.size()) {
            word.span = place(at_, at_);
            return word;
        }
        const std::size_t begin = at_;
        const char first = text_[at_];
        const bool is_number = is_decimal_digit(first) || (first == '.' && at_ + 1 < text_.size() &&
                                                           is_decimal_digit(text_[at_ + 1]));
        if (is_number) {
            word = number_word();
        } else if (is_letter_of_name(first)) {
            while (at_ < text_.size() && is_letter_of_name(text_[at_])) ++at_;
            word.kind = FormulaWord::Kind::name;
            word.text = text_.substr(begin, at_ - begin);
            if (dialect_.ignores_case) {
                std::transform(word.text.begin(), word.text.end(), word.text.begin(), [](char c) {
                    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
                });
            }
        } else {
            word = sign_word();
        }
        word.span = place(begin, std::max(at_, begin + 1));
        return word;
    }

private:
    Span place(std::size_t begin, std::size_t end) const {
        return {span_.source, span_.begin + static_cast<std::uint32_t>(begin),
                span_.begin + static_cast<std::uint32_t>(end)};
    }

    /// Skips blanks, and comments of C.
    void skip() {
        while (at_ < text_.size()) {
            if (std::isspace(static_cast<unsigned char>(text_[at_]))) {
                ++at_;
            } else if (dialect_.is_c && text_.substr(at_).starts_with("//")) {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (dialect_.is_c && text_.substr(at_).starts_with("/*")) {
                const auto end = text_.find("*/", at_ + 2);
                at_ = end == std::string_view::npos ? text_.size() : end + 2;
            } else {
                break;
            }
        }
    }

    void digits() {
        while (at_ < text_.size() && is_decimal_digit(text_[at_])) ++at_;
    }

    FormulaWord number_word() {
        FormulaWord word;
        word.kind = FormulaWord::Kind::number;
        word.is_whole = true;
        const std::size_t begin = at_;
        digits();
        if (at_ < text_.size() && text_[at_] == '.') {
            word.is_whole = false;
            ++at_;
            digits();
        }
        if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
            std::size_t sign = at_ + 1;
            if (sign < text_.size() && (text_[sign] == '+' || text_[sign] == '-')) ++sign;
            if (sign < text_.size() && is_decimal_digit(text_[sign])) {
                word.is_whole = false;
                at_ = sign;
                digits();
            }
        }
        word.text = text_.substr(begin, at_ - begin);
        const bool has_suffix = dialect_.is_c && at_ < text_.size() &&
                                (text_[at_] == 'f' || text_[at_] == 'F') &&
                                (at_ + 1 == text_.size() || !is_letter_of_name(text_[at_ + 1]));
        if (has_suffix) {
            word.is_whole = false;
            ++at_;
        }
        return word;
    }

    FormulaWord sign_word() {
        FormulaWord word;
        for (const auto& [sign, meaning] : foreign_signs) {
            if (!text_.substr(at_).starts_with(sign)) continue;
            at_ += sign.size();
            word.kind = FormulaWord::Kind::sign;
            word.text = meaning;
            return word;
        }
        if (single_signs.find(text_[at_]) != std::string_view::npos) {
            word.kind = FormulaWord::Kind::sign;
            word.text = text_[at_++];
            return word;
        }
        word.text = "wrong";
        return word;
    }

    Span span_;
    std::string_view text_;
    const Dialect& dialect_;
    std::size_t at_ = 0;
};

}  // namespace

std::optional<std::vector<FormulaWord>> formula_words(Span span, const Sources& sources,
                                                      Diagnostics& diagnostics,
                                                      const Dialect& dialect) {
    WordReader reader(span, sources.text(span), dialect);
    std::vector<FormulaWord> words;
    for (;;) {
        words.push_back(reader.next());
        const FormulaWord& last = words.back();
        if (last.kind != FormulaWord::Kind::end) {
            if (words.size() <= most_formula_words) continue;
            diagnostics.error(last.span, fmt::format("the formula has more than {} words",
                                                     most_formula_words));
            return std::nullopt;
        }
        if (last.text.empty()) return words;
        diagnostics.error(last.span, "this character cannot be part of a formula");
        return std::nullopt;
    }
}

}  // namespace cascade::importing
