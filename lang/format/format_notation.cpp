// Respells words in ASCII or in the notation of papers. If a notation omits a word, the word's text
// becomes empty. Examples are brackets after ∇, the sign of a product and the ^ of a superscript.
#include "lang/format/format_notation.h"

#include "lang/syntax/kept_spellings.h"
#include "lang/syntax/paper_notation.h"
#include "lang/vocabulary/greek_letters.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace cascade {

namespace {

constexpr std::size_t no_partner = ~std::size_t{0};

class PaperWriter {
public:
    explicit PaperWriter(std::vector<FormatWord>& words) : words_(words) {}

    void run() {
        find_brackets();
        ends_application_.assign(words_.size(), false);
        is_operator_.assign(words_.size(), false);
        for (std::size_t k = 0; k < words_.size(); ++k) respell(k);
        for (std::size_t k = 0; k < words_.size(); ++k) write_operator(k);
        write_bare_laplacians();
        for (std::size_t k = 0; k < words_.size(); ++k) write_power(k);
        leave_out_products();
    }

private:
    TokenKind kind(std::size_t k) const {
        return k < words_.size() ? words_[k].kind : TokenKind::end_of_text;
    }
    /// Whether the words from `first` to `last`, both included, are on one line, without comments
    /// between them.
    bool is_on_one_line(std::size_t first, std::size_t last) const {
        for (std::size_t k = first; k <= last; ++k) {
            if (k >= words_.size() || words_[k].breaks > 0 || words_[k].is_comment()) return false;
        }
        return true;
    }

    void find_brackets() {
        partner_.assign(words_.size(), no_partner);
        std::vector<std::size_t> open;
        for (std::size_t k = 0; k < words_.size(); ++k) {
            const TokenKind here = kind(k);
            if (here == TokenKind::open_round || here == TokenKind::open_square) open.push_back(k);
            const bool closes = here == TokenKind::close_round || here == TokenKind::close_square;
            if (!closes || open.empty()) continue;
            partner_[k] = open.back();
            partner_[open.back()] = k;
            open.pop_back();
        }
    }

    void respell(std::size_t k) {
        FormatWord& word = words_[k];
        switch (word.kind) {
            case TokenKind::name: word.text = kept_spelling(with_greek_letters(word.text)); break;
            case TokenKind::star: word.text = "·"; break;
            case TokenKind::minus: word.text = "−"; break;
            case TokenKind::less_equal: word.text = "≤"; break;
            case TokenKind::greater_equal: word.text = "≥"; break;
            case TokenKind::not_equal: word.text = "≠"; break;
            case TokenKind::prime: write_prime(k); break;
            default: break;
        }
    }
    /// Respells the prime after a species: u' = … becomes ∂u/∂t = …, and u'' = … becomes ∂²u/∂t² =
    /// …. Any other prime becomes ′.
    void write_prime(std::size_t k) {
        words_[k].text = "′";
        const TokenKind next = kind(k + 1);
        if (next != TokenKind::assign && next != TokenKind::plus_assign) return;
        const bool is_second = kind(k - 1) == TokenKind::prime;
        std::size_t name = k - (is_second ? 2 : 1);
        if (kind(name) == TokenKind::close_square && partner_[name] != no_partner) {
            name = partner_[name] - 1;
        }
        if (kind(name) != TokenKind::name || !is_on_one_line(name + 1, k)) return;
        words_[name].text =
            kept_spelling((is_second ? "∂²" : "∂") + std::string(words_[name].text));
        words_[k].text = is_second ? "/∂t²" : "/∂t";
        if (is_second) words_[k - 1].text = "";
    }

    /// The sign that papers write for a function with one operand, such as ∇² for lap. Empty for
    /// other words.
    static std::string_view sign_of(std::string_view function) {
        constexpr std::array<std::pair<std::string_view, std::string_view>, 4> signs{
            {{"lap", "∇²"}, {"div", "∇·"}, {"grad", "∇"}, {"sqrt", "√"}}};
        const auto found = std::find_if(signs.begin(), signs.end(),
                                        [&](const auto& row) { return row.first == function; });
        return found == signs.end() ? std::string_view() : found->second;
    }
    /// Whether the word `name` begins a call that can be written with a sign.
    bool is_application(std::size_t name) const {
        const bool is_call =
            kind(name) == TokenKind::name && kind(name + 1) == TokenKind::open_round;
        if (!is_call || sign_of(words_[name].spelling).empty()) return false;
        const std::size_t open = name + 1, close = partner_[open];
        if (close == no_partner || close == open + 1) return false;
        const bool is_defined =
            name > 0 && kind(name - 1) == TokenKind::name && !words_[name - 1].is_infix;
        const bool is_of_stage = name > 0 && kind(name - 1) == TokenKind::dot;
        if (is_defined || is_of_stage || kind(close + 1) == TokenKind::caret) return false;
        for (std::size_t k = open + 1; k < close; ++k) {
            if (kind(k) == TokenKind::comma) return false;
            const bool opens =
                kind(k) == TokenKind::open_round || kind(k) == TokenKind::open_square;
            if (opens && partner_[k] != no_partner) k = partner_[k];
        }
        return is_on_one_line(open, open + 1);
    }
    /// Whether an operand needs no brackets after a sign. True for a number, for u, u[i] and u',
    /// and for a call that is itself written with a sign.
    bool is_plain_operand(std::size_t first, std::size_t end) const {
        if (kind(first) == TokenKind::number) return first + 1 == end;
        if (kind(first) != TokenKind::name) return false;
        if (is_application(first)) return partner_[first + 1] + 1 == end;
        std::size_t k = first + 1;
        if (kind(k) == TokenKind::open_square && words_[k].blanks == 0 &&
            partner_[k] != no_partner) {
            k = partner_[k] + 1;
        }
        if (kind(k) == TokenKind::prime) ++k;
        return k == end;
    }
    void write_operator(std::size_t name) {
        if (words_[name].text.empty() || !is_application(name)) return;
        std::size_t open = name + 1, close = partner_[open];
        words_[name].text = sign_of(words_[name].spelling);
        is_operator_[name] = true;
        ends_application_[close] = true;
        const std::size_t inner = open + 1;
        const bool is_twice = words_[name].spelling == "lap" && words_[inner].spelling == "lap" &&
                              is_application(inner) && partner_[inner + 1] + 1 == close &&
                              is_on_one_line(open, close);
        if (is_twice) {
            words_[name].text = "∇⁴";
            words_[open].text = words_[inner].text = words_[close].text = {};
            open = inner + 1;
            close = partner_[open];
            ends_application_[close] = true;
        }
        const bool is_plain = is_plain_operand(open + 1, close) && is_on_one_line(open, close);
        if (is_plain) words_[open].text = words_[close].text = {};
    }

    /// Turns (1 + lap)^2 u into (1 + ∇²)² u, unless the script gives the name lap a value.
    void write_bare_laplacians() {
        const auto is_bare = [&](std::size_t k) {
            return kind(k) == TokenKind::name && words_[k].spelling == "lap" &&
                   kind(k + 1) != TokenKind::open_round;
        };
        const auto ends_sum = [&](std::size_t k) {
            return kind(k) == TokenKind::close_round || kind(k) == TokenKind::plus ||
                   kind(k) == TokenKind::minus;
        };
        for (std::size_t k = 0; k < words_.size(); ++k) {
            if (is_bare(k) && !ends_sum(k + 1)) return;
        }
        for (std::size_t k = 0; k < words_.size(); ++k) {
            if (is_bare(k)) words_[k].text = "∇²";
        }
    }

    /// Turns u^2 into u² and u^-1 into u⁻¹.
    void write_power(std::size_t caret) {
        if (kind(caret) != TokenKind::caret || caret == 0) return;
        const bool is_negative = kind(caret + 1) == TokenKind::minus;
        const std::size_t number = caret + (is_negative ? 2 : 1);
        const bool is_number = kind(number) == TokenKind::number && is_on_one_line(caret, number);
        if (!is_number || kind(number + 1) == TokenKind::caret) return;
        const std::string_view digits = words_[number].spelling;
        if (digits.find_first_not_of("0123456789") != std::string_view::npos) return;
        constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴",
                                                          "⁵", "⁶", "⁷", "⁸", "⁹"};
        std::string text;
        for (const char digit : digits) text += raised[static_cast<std::size_t>(digit - '0')];
        words_[number].text = kept_spelling(text);
        words_[number].is_raised = true;
        words_[caret].text = {};
        if (is_negative) words_[caret + 1].text = "⁻";
    }

    /// Removes the signs of products before ∇ or √ and after a superscript.
    void leave_out_products() {
        std::vector<bool> divisors;
        bool is_divisor = false;
        for (std::size_t k = 0; k < words_.size(); ++k) {
            switch (kind(k)) {
                case TokenKind::open_round:
                case TokenKind::open_square:
                    divisors.push_back(is_divisor);
                    is_divisor = false;
                    break;
                case TokenKind::close_round:
                case TokenKind::close_square:
                    if (divisors.empty()) break;
                    is_divisor = divisors.back();
                    divisors.pop_back();
                    break;
                case TokenKind::slash: is_divisor = true; break;
                case TokenKind::plus: is_divisor = false; break;
                case TokenKind::minus: is_divisor = is_divisor && words_[k].is_sign; break;
                case TokenKind::star:
                    if (!is_divisor && is_clear_product(k)) words_[k].text = {};
                    break;
                case TokenKind::name:
                case TokenKind::number:
                case TokenKind::caret:
                case TokenKind::prime:
                case TokenKind::dot:
                case TokenKind::newline: break;  // A token of kind newline is a comment.
                default: is_divisor = false;
            }
        }
    }
    bool is_clear_product(std::size_t star) const {
        if (star == 0 || star + 1 >= words_.size() || !is_on_one_line(star, star + 1)) return false;
        const FormatWord &left = words_[star - 1], &right = words_[star + 1];
        if (ends_application_[star - 1] || left.is_comment()) return false;
        if (is_operator_[star + 1]) return true;
        if (!left.is_raised) return false;
        if (right.kind == TokenKind::open_round) return true;
        return right.kind == TokenKind::name && !is_word_between_operands(right.spelling);
    }

    std::vector<FormatWord>& words_;
    /// For each opening or closing bracket, the index of the matching bracket.
    std::vector<std::size_t> partner_;
    std::vector<bool> is_operator_, ends_application_;
};

std::string_view without_blanks(std::string_view text) {
    if (text.find_first_of(" \t") == std::string_view::npos) return text;
    std::string tight(text);
    tight.erase(std::remove_if(tight.begin(), tight.end(),
                               [](char c) { return c == ' ' || c == '\t'; }),
                tight.end());
    return kept_spelling(tight);
}

}  // namespace

std::vector<FormatWord> written_words(std::vector<FormatWord> words, ScriptNotation notation) {
    for (FormatWord& word : words) {
        if (word.is_comment() || word.kind == TokenKind::text) continue;
        if (notation == ScriptNotation::as_written) word.text = without_blanks(word.text);
        else word.text = word.spelling;
    }
    if (notation == ScriptNotation::papers) PaperWriter(words).run();
    std::vector<FormatWord> written;
    std::optional<std::size_t> gap;
    for (FormatWord& word : words) {
        if (word.is_comment() || !word.text.empty()) {
            if (gap) word.gap = gap;
            gap.reset();
            written.push_back(word);
            continue;
        }
        switch (word.kind) {
            case TokenKind::open_round:
            case TokenKind::caret: gap = 0; break;
            case TokenKind::star: gap = word.is_spaced ? 1 : 0; break;
            default: break;
        }
    }
    return written;
}

}  // namespace cascade
