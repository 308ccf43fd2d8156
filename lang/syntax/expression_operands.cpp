// Parses the parts of an expression that can begin an operand: numbers, names in all forms,
// strings, signs, brackets.
#include "core/decimal.h"
#include "lang/syntax/expression_parser.h"
#include "lang/syntax/kept_spellings.h"
#include "lang/syntax/second_rates.h"
#include "lang/vocabulary/signs_elsewhere.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

// Literals outside of these limits are reported as probable mistakes: they round to infinity in
// single precision (from half a unit above the largest number), or they are flushed to zero.
constexpr double too_large = 0x1.ffffffp127;
constexpr double smallest = 0x1p-126;

}  // namespace

ExpressionParser::Progress ExpressionParser::read_operand() {
    if (!pending_.empty() && cursor_.take_if(TokenKind::newline) &&
        (cursor_.begins_statement() || cursor_.at_statement_end())) {
        cursor_.step_back();
    }
    const Token token = cursor_.peek();
    switch (token.kind) {
        case TokenKind::number: return read_number();
        case TokenKind::name: return read_name();
        case TokenKind::open_square: return read_bracketed();
        case TokenKind::keyword_not: return read_not();
        case TokenKind::prime: return read_text_in_primes();
        case TokenKind::text: {
            const std::string_view text = cursor_.text(cursor_.take());
            push_operand(token.span, ast::Text{std::string(text.substr(1, text.size() - 2))});
            return Progress::going_on;
        }
        case TokenKind::open_round:
            push_bracket(PendingKind::group, cursor_.take(), {});
            return Progress::going_on;
        case TokenKind::minus: {
            Pending negate;
            negate.kind = PendingKind::unary;
            negate.op = Function::negate;
            negate.token = cursor_.take();
            pending_.push_back(negate);
            return Progress::going_on;
        }
        case TokenKind::plus: {
            const TokenKind before = cursor_.previous().kind;
            const bool is_after_operator = !pending_.empty() && wants_operand(before);
            if (is_after_operator && before != TokenKind::comma) break;
            while (cursor_.take_if(TokenKind::plus)) {
            }
            cursor_.error(token.span, "a number is written without '+'", "leave it out");
            return Progress::going_on;
        }
        case TokenKind::garbage:  // An error has already been reported by the lexer.
            cursor_.take();
            push_operand(token.span, ast::Garbage{});
            return Progress::going_on;
        case TokenKind::close_round: {
            const bool is_empty_call = !pending_.empty() &&
                                       pending_.back().kind == PendingKind::call &&
                                       cursor_.previous().kind == TokenKind::open_round;
            return is_empty_call ? read_close_round() : missing_operand();
        }
        default: break;
    }
    return missing_operand();
}

ExpressionParser::Progress ExpressionParser::read_number() {
    const Token token = cursor_.take();
    const std::string_view text = cursor_.text(token);
    double value = 0;
    const auto result = from_decimal(text.data(), text.data() + text.size(), value);
    const bool vanishes = value != 0 && std::abs(value) < smallest;
    if (result.ec != std::errc() || value >= too_large || vanishes) {
        cursor_.error(token.span, "number out of range",
                      "numbers other than 0 are from 1.18e-38 to 3.4e38");
        push_operand(token.span, ast::Garbage{});
    } else {
        push_operand(token.span, ast::Number{value});
    }
    return read_unit();
}

/// Reads the unit after a number, if there is one. A number that is an exponent has no unit.
ExpressionParser::Progress ExpressionParser::read_unit() {
    const auto applies = [&](std::size_t depth, Function op) {
        return pending_.size() >= depth && !pending_[pending_.size() - depth].is_bracket() &&
               pending_[pending_.size() - depth].op == op;
    };
    const bool is_exponent = applies(1, Function::power) ||
                             (applies(1, Function::negate) && applies(2, Function::power));
    const bool ends = std::ranges::any_of(ends_, [&](auto word) { return cursor_.at_name(word); });
    if (is_exponent || ends) return Progress::going_on;
    const UnitSuffix unit = cursor_.unit_here();
    if (!unit.message.empty()) return fail(unit.span, unit.message, unit.hint);
    if (unit.tokens == 0) return Progress::going_on;
    const Token first = cursor_.peek();
    for (std::size_t k = 0; k < unit.tokens; ++k) cursor_.take();
    const ast::Word word{join(first.span, cursor_.previous().span), kept_spelling(" " + unit.text)};
    const Operand number = operands_.back();
    operands_.pop_back();
    if (std::holds_alternative<ast::Garbage>(script_.expressions[number.id].node)) {
        push_operand(join(number.outer, word.span), ast::Garbage{});
        return Progress::going_on;
    }
    const auto argument = static_cast<std::uint32_t>(script_.arguments.size());
    script_.arguments.push_back(number.id);
    push_operand(join(number.outer, word.span), ast::Call{word, argument, 1});
    return Progress::going_on;
}

/// Reads name, name', stage.name, vector.x, or the beginning of a call.
ExpressionParser::Progress ExpressionParser::read_name() {
    const Token token = cursor_.take();
    const ast::Word name = cursor_.word(token);
    if (cursor_.at(TokenKind::open_round)) {
        push_bracket(PendingKind::call, cursor_.take(), name);
        return Progress::going_on;
    }
    if (cursor_.at(TokenKind::prime)) {
        Token prime = cursor_.take();
        ast::Word species = name;
        if (cursor_.at(TokenKind::prime)) {  // u'' means the rate of u_t.
            prime = cursor_.take();
            species.text = name_of_rate(name.text);
        }
        push_operand(join(token.span, prime.span), ast::RateOf{species});
        return Progress::going_on;
    }
    if (!cursor_.at(TokenKind::dot)) {
        push_operand(token.span, ast::Name{name.text});
        return Progress::going_on;
    }
    const Token dot = cursor_.take();
    if (!cursor_.at(TokenKind::name)) {
        if (cursor_.at(TokenKind::garbage)) return fail_silently();
        return fail(join(token.span, dot.span),
                    fmt::format("a name is missing after '{}.'", shortened(name.text)),
                    "p of an earlier stage is written stage.p");
    }
    const Token part = cursor_.take();
    if (const auto axis = component_named(cursor_.text(part))) {
        push_operand(token.span, ast::Name{name.text});
        push_component(*axis, cursor_.word(part));
        return Progress::going_on;
    }
    push_operand(join(token.span, part.span), ast::Qualified{name, cursor_.word(part)});
    return Progress::going_on;
}

/// Reads [name]. If the brackets contain anything else, skips it up to the closing bracket.
ExpressionParser::Progress ExpressionParser::read_bracketed() {
    const bool is_range = cursor_.previous().kind == TokenKind::name;
    const Token open = cursor_.take();
    cursor_.skip_newlines();
    const Token inner = cursor_.peek();
    if (inner.kind == TokenKind::name && cursor_.kind(1) == TokenKind::open_square) {
        return read_own_member();
    }
    if (inner.kind == TokenKind::name) {
        const bool on_next_line = cursor_.kind(1) == TokenKind::newline;
        if (cursor_.kind(on_next_line ? 2 : 1) == TokenKind::close_square) {
            cursor_.take();
            cursor_.skip_newlines();
            const Token close = cursor_.take();
            push_operand(join(open.span, close.span), ast::Bracketed{cursor_.word(inner)});
            return Progress::going_on;
        }
    }
    bool is_readable = true;
    std::size_t depth = 1;
    while (depth > 0) {
        const bool line_ends = cursor_.at(TokenKind::newline) && cursor_.begins_statement(1);
        const bool text_ends = cursor_.at_statement_end() && !cursor_.at(TokenKind::newline);
        if (line_ends || text_ends) {
            return fail(open.span, "this '[' is never closed", "a ']' is missing after the name");
        }
        is_readable = is_readable && !cursor_.at(TokenKind::garbage);
        if (cursor_.at(TokenKind::open_square)) ++depth;
        if (cursor_.at(TokenKind::close_square)) --depth;
        cursor_.take();
    }
    const Span whole = join(open.span, cursor_.previous().span);
    if (is_readable) {
        const bool is_list = cursor_.text(whole).find(',') != std::string_view::npos;
        std::string hint = "( ) groups an expression";
        if (is_list)
            hint = "a list is the value of a setting, without brackets, as in grid: 64, 64";
        if (is_range) hint = "a range is written 0 .. 1";
        cursor_.error(whole, "'[ ]' can contain only one name of this stage", std::move(hint));
    }
    push_operand(whole, ast::Garbage{});
    return Progress::going_on;
}

/// Reads [name[index]]. The outer bracket has been read, and the index follows.
ExpressionParser::Progress ExpressionParser::read_own_member() {
    const Token outer = cursor_.previous();
    const Token name = cursor_.take();
    push_operand(join(outer.span, name.span), ast::Bracketed{cursor_.word(name)});
    push_bracket(PendingKind::index, cursor_.take(), {outer.span, {}});
    pending_.back().is_own = true;
    return Progress::going_on;
}

/// Reads `not`. Reports a `not` after an operator that binds more tightly: in `a + not b`, the
/// operand of `not` would not be b alone.
ExpressionParser::Progress ExpressionParser::read_not() {
    Pending logical_not;
    logical_not.kind = PendingKind::unary;
    logical_not.op = Function::logical_not;
    logical_not.token = cursor_.take();
    const bool is_misplaced = !pending_.empty() && !pending_.back().is_bracket() &&
                              pending_.back().precedence() > logical_not.precedence();
    if (is_misplaced) {
        cursor_.error(logical_not.token.span,
                      fmt::format("'not' cannot directly follow {}",
                                  cursor_.describe(pending_.back().token)),
                      "put it in brackets: (not …)");
    }
    pending_.push_back(logical_not);
    return Progress::going_on;
}

/// Reports a string in single quotes: 'tan' written for "tan".
ExpressionParser::Progress ExpressionParser::read_text_in_primes() {
    const bool is_text = cursor_.kind(1) == TokenKind::name && cursor_.kind(2) == TokenKind::prime;
    if (!is_text) return missing_operand();
    const Span open = cursor_.take().span;
    const Token word = cursor_.take();
    const Span whole = join(open, cursor_.take().span);
    cursor_.error(whole, "a text needs double quotes",
                  fmt::format("write \"{}\"", shortened(cursor_.text(word))));
    push_operand(whole, ast::Garbage{});
    return Progress::going_on;
}

/// Reports that no expression can begin with the token at the cursor.
ExpressionParser::Progress ExpressionParser::missing_operand() {
    const Token before = cursor_.previous();
    const Token here = cursor_.peek();
    const bool ends = cursor_.at_statement_end();
    const bool closes = here.kind == TokenKind::close_round || here.kind == TokenKind::close_square;
    if (closes && open_brackets_ == 0) {
        return fail(here.span, fmt::format("this '{}' closes nothing", cursor_.text(here)));
    }
    if (ends && pending_.empty() && before.kind != TokenKind::comma) {
        return fail(before.span, owner_ + " is missing",
                    advice_about_hex_colour(cursor_.rest_of_line(before)));
    }
    const bool is_open = before.kind == TokenKind::open_round || before.kind == TokenKind::comma;
    if (ends && is_open && open_brackets_ > 0) return unclosed();
    if (ends || closes) {
        return fail(before.span, "an expression is missing after " + cursor_.describe(before));
    }
    const bool is_tex = here.kind == TokenKind::open_curly && before.kind == TokenKind::caret;
    return fail(here.span, "an expression is missing before " + cursor_.describe(here),
                is_tex ? "( ) groups an expression, as in u^(n + 1)" : "");
}

}  // namespace cascade
