// Replaces signs of papers by tokens of the language, in one pass from left to right.
#include "lang/syntax/paper_notation.h"

#include "core/utf8.h"
#include "lang/syntax/kept_spellings.h"
#include "lang/syntax/paper_tokens.h"
#include "lang/syntax/token_cursor.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace cascade {

namespace {

class PaperReader : private PaperTokens {
public:
    PaperReader(const std::vector<Token>& in, std::string_view text, Diagnostics& diagnostics)
        : PaperTokens(in, text), diagnostics_(diagnostics) {}

    std::vector<Token> run() {
        out_.reserve(in_.size() + in_.size() / 4);
        while (at_ < in_.size()) {
            if (const auto end = derivative_ends_.find(at_); end != derivative_ends_.end()) {
                end_derivative(end->second);
            } else {
                read();
            }
        }
        return std::move(out_);
    }

private:
    /// An open bracket, and the parser's state before the bracket. The closing bracket restores
    /// this state.
    struct Open {
        /// How many brackets to close after this bracket, which were opened for operators.
        std::size_t closings = 0;
        /// Whether the bracket is in a product and after a division sign.
        bool is_divisor = false;
        bool is_operators = false;  ///< Whether the bracket contains the operand of an operator.
    };
    /// The end of a derivative: `/∂t` or `/∂x`.
    struct DerivativeEnd {
        TokenKind kind = TokenKind::prime;
        /// Whether the derivative is ∂²u/∂t², which becomes two primes.
        bool is_second_prime = false;
        Token last;
        std::size_t size = 0;  ///< The number of tokens in the source.
    };

    void read() {
        switch (kind(at_)) {
            case TokenKind::nabla:
            case TokenKind::laplacian:
            case TokenKind::root: return read_operator();
            case TokenKind::partial: return read_partial();
            case TokenKind::superscript: return read_superscript();
            case TokenKind::open_round:
            case TokenKind::open_square: return read_open();
            case TokenKind::close_round:
            case TokenKind::close_square: return read_close();
            case TokenKind::name:
                if (is_after_power() && !is_word_between_operands(token(at_).text) &&
                    !begins_statement(at_)) {
                    multiply();
                }
                return read_operand();
            case TokenKind::number:
            case TokenKind::prime: return read_operand();
            case TokenKind::slash: is_divisor_ = true; break;
            case TokenKind::star: break;
            case TokenKind::caret: read_caret(); break;
            case TokenKind::plus:
            case TokenKind::minus:
                if (at_ > 0 && ends_operand(at_ - 1)) is_divisor_ = false;
                break;
            case TokenKind::newline:
                if (at_ == 0 || !wants_operand(kind(at_ - 1))) is_divisor_ = false;
                break;
            case TokenKind::open_curly:
            case TokenKind::close_curly:
                open_.clear();
                closings_ = 0;
                is_divisor_ = false;
                break;
            default: is_divisor_ = false;
        }
        put(token(at_++));
    }

    /// Adds the product sign that the source omits before the present token.
    void multiply() {
        const Token& here = token(at_);
        if (is_after_application() || is_divisor_) {
            diagnostics_.error(
                here.span,
                fmt::format("it is not clear what is multiplied before '{}'", source(here.span)),
                is_divisor_ ? "write the divisor in brackets, or '·' for the product"
                            : "write the operand in brackets and '·' for the product");
            return put(TokenKind::garbage, before(here), {});
        }
        put(TokenKind::star, before(here), "*");
    }

    /// Reads a name, a number, or a prime after a name.
    void read_operand() {
        put(token(at_));
        const bool is_name = kind(at_) == TokenKind::name && !is_between_operands(at_);
        ++at_;
        if (is_name && goes_on()) return;
        end_operand();
    }
    /// Whether the present token continues the operand before it.
    bool goes_on() const {
        switch (kind(at_)) {
            case TokenKind::open_round:
            case TokenKind::prime: return true;
            case TokenKind::open_square: return is_adjacent(at_);
            case TokenKind::dot: return kind(at_ + 1) == TokenKind::name;
            default: return false;
        }
    }
    /// Closes the brackets that were opened for operators whose operand ends before the present
    /// token.
    void end_operand() {
        if (closings_ == 0) return;
        for (; closings_ > 0; --closings_) {
            put(TokenKind::close_round, after(token(at_ - 1)), ")");
        }
        application_end_ = at_ - 1;
    }

    void read_open() {
        const bool is_round = kind(at_) == TokenKind::open_round;
        if (is_round && is_after_power()) multiply();
        open_bracket();
    }
    void open_bracket() {
        open_.push_back({closings_, is_divisor_, false});
        closings_ = 0;
        is_divisor_ = false;
        put(token(at_++));
    }
    void read_close() {
        const bool is_square = kind(at_) == TokenKind::close_square;
        put(token(at_++));
        if (open_.empty()) return;
        const Open open = open_.back();
        open_.pop_back();
        is_divisor_ = open.is_divisor;
        closings_ = open.closings;
        if (open.is_operators) application_end_ = at_ - 1;
        if (is_square && kind(at_) == TokenKind::prime) return;
        end_operand();
    }

    /// Reads an operator: ∇, ∇², ∇·, Δ or √.
    void read_operator() {
        if (at_ > 0 && ends_operand(at_ - 1)) multiply();
        Token sign = token(at_);
        std::string_view function = sign.kind == TokenKind::nabla       ? "grad"
                                    : sign.kind == TokenKind::laplacian ? "lap"
                                                                        : "sqrt";
        std::size_t times = 1;
        ++at_;
        if (sign.kind == TokenKind::nabla && kind(at_) == TokenKind::star &&
            source(token(at_).span) != "*") {
            function = "div";
            sign.span = join(sign.span, token(at_).span);
            if (source(token(at_).span) == "×") {
                diagnostics_.error(sign.span, "there is no curl in the language");
            }
            ++at_;
        } else if (sign.kind != TokenKind::root && kind(at_) == TokenKind::superscript) {
            sign.span = join(sign.span, token(at_).span);
            times = times_applied(sign, token(at_));
            function = "lap";
            ++at_;
        }
        if (sign.kind == TokenKind::laplacian && is_adjacent(at_) && is_width(token(at_))) {
            diagnostics_.error(join(sign.span, token(at_).span),
                               "Δ is the Laplacian and cannot be part of a width",
                               fmt::format("give the width a name, as in d_{}", token(at_).text));
        }
        const bool is_alone = kind(at_) == TokenKind::close_round || kind(at_) == TokenKind::plus ||
                              kind(at_) == TokenKind::minus;
        // As in (1 + ∇²)² u, where the operator has no operand of its own.
        if (is_alone && !open_.empty() && function == "lap") {
            put(TokenKind::name, sign.span, function);
            if (times > 1) {
                put(TokenKind::caret, after(sign), "^");
                put(TokenKind::number, after(sign), kept_spelling(std::to_string(times)));
            }
            return end_operand();
        }
        if (!begins_operand(at_)) {
            diagnostics_.error(sign.span,
                               fmt::format("the operand of '{}' is missing", source(sign.span)),
                               fmt::format("write {0}u or {0}(…)", source(sign.span)));
            put(TokenKind::garbage, sign.span, source(sign.span));
            return end_operand();
        }
        for (std::size_t k = 1; k < times; ++k) {
            put(TokenKind::name, k == 1 ? sign.span : after(sign), function);
            put(TokenKind::open_round, after(sign), "(");
        }
        put(TokenKind::name, times == 1 ? sign.span : after(sign), function);
        if (kind(at_) == TokenKind::open_round) {
            closings_ += times - 1;
            open_bracket();
            open_.back().is_operators = true;
        } else {
            put(TokenKind::open_round, after(sign), "(");
            closings_ += times;
        }
    }
    /// How many times an operator such as ∇², ∇⁴ or Δ² means that the Laplacian is applied.
    std::size_t times_applied(const Token& sign, const Token& power) {
        const std::string digits = digits_of(source(power.span));
        constexpr std::array<std::string_view, 4> even{"2", "4", "6", "8"};
        constexpr std::array<std::string_view, 3> whole{"2", "3", "4"};
        const bool is_nabla = sign.kind == TokenKind::nabla;
        const auto find = [&](const auto& powers, std::size_t first) {
            const auto found = std::find(powers.begin(), powers.end(), digits);
            if (found != powers.end()) {
                return static_cast<std::size_t>(found - powers.begin()) + first;
            }
            diagnostics_.error(
                sign.span,
                fmt::format("'{}' is not an operator of the language", source(sign.span)),
                is_nabla ? "there are ∇, ∇², ∇⁴, ∇⁶ and ∇⁸" : "there are Δ, Δ², Δ³ and Δ⁴");
            return std::size_t{1};
        };
        return is_nabla ? find(even, 1) : find(whole, 2);
    }
    static std::string digits_of(std::string_view raised) {
        std::string digits;
        for (std::size_t offset = 0; offset < raised.size();) {
            const CodePoint point = decode_utf8(raised, offset);
            digits += superscript_digit(point.value).value_or('0');
            offset += point.size;
        }
        return digits;
    }

    void read_superscript() {
        const Token power = token(at_);
        const std::string digits = digits_of(source(power.span));
        const bool is_negative = digits[0] == '-';
        if (at_ == 0 || !ends_operand(at_ - 1) || !is_adjacent(at_) || is_after_power() ||
            digits == "-") {
            diagnostics_.error(power.span, "a raised exponent must directly follow its base",
                               fmt::format("write u{}", digits == "-" ? "⁻¹" : source(power.span)));
            ++at_;
            return;
        }
        refuse_power_of_application(power);
        const Token& base = token(at_ - 1);
        if (base.kind == TokenKind::name && function_named(base.text) &&
            kind(at_ + 1) == TokenKind::open_round) {
            diagnostics_.error(join(base.span, power.span),
                               "the power of a function must follow its brackets",
                               fmt::format("write {}(…){}", base.text, source(power.span)));
        }
        put(TokenKind::caret, before(power), "^");
        Span number = power.span;
        if (is_negative) {
            const auto sign_end = power.span.begin + decode_utf8(source(power.span), 0).size;
            put(TokenKind::minus, {number.source, number.begin, sign_end}, "-");
            number.begin = sign_end;
        }
        put(TokenKind::number, number, kept_spelling(digits.substr(is_negative ? 1 : 0)));
        power_end_ = at_++;
    }
    void read_caret() {
        const Token& caret = token(at_);
        refuse_power_of_application(caret);
        if (is_after_power()) {
            diagnostics_.error(caret.span, "it is unclear which power comes first", "write (u²)^n");
        }
    }
    /// Reports a power after an operator and its operand, because it is ambiguous: ∇²u² may mean
    /// (∇²u)² or ∇²(u²).
    void refuse_power_of_application(const Token& power) {
        if (!is_after_application()) return;
        diagnostics_.error(power.span, "it is unclear what is raised to the power",
                           "put the operator with its operand, or the power, in brackets");
    }

    /// Reads a derivative: ∂u/∂t, ∂²u/∂t², ∂u/∂x, ∂²u/∂x² or ∂²u/∂x∂y. In place of u, there may be
    /// u[i].
    void read_partial() {
        const std::size_t begin = at_;
        if (at_ > 0 && ends_operand(at_ - 1)) multiply();
        const bool is_second = kind(at_ + 1) == TokenKind::superscript;
        const std::size_t name = at_ + (is_second ? 2 : 1);
        std::size_t slash = name + 1;
        if (kind(slash) == TokenKind::open_square && is_adjacent(slash))
            slash = end_of_index(slash);
        const std::string_view axis = axis_of(slash);
        const std::string_view other = is_second ? second_axis(slash, axis) : std::string_view();
        const bool has_power = !is_second || source(token(at_ + 1).span) == "²";
        const bool is_whole = kind(name) == TokenKind::name && kind(slash) == TokenKind::slash &&
                              !axis.empty() && has_power && (!is_second || !other.empty());
        const bool is_mixed = is_second && kind(slash + 3) == TokenKind::partial;
        const std::size_t size = is_mixed ? 5 : is_second ? 4 : 3;
        if (!is_whole || (is_second && axis != other && (axis == "t" || other == "t"))) {
            diagnostics_.error(is_whole ? join(token(begin).span, token(slash + size - 1).span)
                                        : token(begin).span,
                               "this derivative is not part of the language",
                               "write ∂u/∂t, ∂²u/∂t², ∂u/∂x, ∂²u/∂x² or ∂²u/∂x∂y");
            put(TokenKind::garbage, token(begin).span, source(token(begin).span));
            const bool is_other = kind(slash) == TokenKind::slash &&
                                  // True for ∂u/∂r, for example.
                                  kind(slash + 1) == TokenKind::partial;
            at_ = is_whole ? slash + size : is_other ? slash + 2 : begin + (is_second ? 2 : 1);
            return;
        }
        if (begin > 0 && kind(begin - 1) == TokenKind::slash) {
            diagnostics_.error(token(begin).span, "it is unclear what is divided", "write (∂u/∂x)");
        }
        const Token& last = token(slash + size - 1);
        if (axis == "t") {
            put(TokenKind::name, join(token(begin).span, token(name).span), token(name).text);
            derivative_ends_[slash] = {TokenKind::prime, is_second, last, size};
        } else {
            Token sign = token(begin);
            if (is_second) sign.span = join(sign.span, token(begin + 1).span);
            put(TokenKind::name, sign.span,
                kept_spelling("d" + std::string(std::min(axis, other.empty() ? axis : other)) +
                              std::string(other.empty() ? other : std::max(axis, other))));
            put(TokenKind::open_round, after(sign), "(");
            put(token(name));
            derivative_ends_[slash] = {TokenKind::close_round, false, last, size};
        }
        at_ = name + 1;
    }

    void end_derivative(const DerivativeEnd& end) {
        const Span span = join(token(at_).span, end.last.span);
        put(end.kind, span, end.kind == TokenKind::prime ? "'" : ")");
        if (end.is_second_prime) put(end.kind, after(end.last), "'");
        at_ += end.size;
        application_end_ = at_ - 1;
        end_operand();
    }

    Diagnostics& diagnostics_;
    std::vector<Open> open_;
    std::size_t closings_ = 0;  ///< The number of brackets to close after the present operand.
    /// Whether the present position is in a product and after a division sign.
    bool is_divisor_ = false;
    std::map<std::size_t, DerivativeEnd> derivative_ends_;
};

}  // namespace

bool is_sign_of_papers(TokenKind kind) {
    return kind == TokenKind::nabla || kind == TokenKind::laplacian || kind == TokenKind::root ||
           kind == TokenKind::partial || kind == TokenKind::superscript;
}

std::optional<char> superscript_digit(char32_t code_point) {
    switch (code_point) {
        case U'¹': return '1';
        case U'²': return '2';
        case U'³': return '3';
        case U'⁻': return '-';
        default: break;
    }
    const bool is_digit = code_point >= U'⁰' && code_point <= U'⁹' && code_point != U'ⁱ';
    if (!is_digit) return std::nullopt;
    return static_cast<char>('0' + static_cast<char>(code_point - U'⁰'));
}

bool is_word_between_operands(std::string_view word) {
    return word == "over" || word == "in" || word == "step" || word == "after";
}

std::vector<Token> without_paper_notation(const std::vector<Token>& tokens, std::string_view text,
                                          Diagnostics& diagnostics) {
    return PaperReader(tokens, text, diagnostics).run();
}

}  // namespace cascade
