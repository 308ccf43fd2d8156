// Parses expressions after an operand: operators, commas, closing brackets, and the end.
#include "lang/syntax/expression_parser.h"
#include "lang/vocabulary/functions.h"
#include "lang/vocabulary/signs_elsewhere.h"
#include "lang/vocabulary/words_elsewhere.h"
#include "lang/syntax/operator_polynomials.h"
#include "lang/syntax/second_rates.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace cascade {

namespace {

/// The operator that a token between two operands means. `=` is read as `==`.
std::optional<Function> binary_of(TokenKind kind) {
    static const auto operators = [] {
        std::array<std::optional<Function>, static_cast<std::size_t>(TokenKind::bar) + 1> table;
        for (std::size_t t = 0; t < table.size(); ++t) {
            const auto token = static_cast<TokenKind>(t);
            const auto text = spelling(token == TokenKind::assign ? TokenKind::equal : token);
            for (std::size_t k = 0; k < function_count; ++k) {
                const FunctionInfo& row = info(static_cast<Function>(k));
                const bool is_binary = row.is_operator && row.arity.takes(2);
                if (is_binary && row.spelling == text) table[t] = static_cast<Function>(k);
            }
        }
        return table;
    }();
    return operators[static_cast<std::size_t>(kind)];
}

constexpr const char* form_of_near = "such as sum(e over near(0.1))";
constexpr const char* form_of_over = "write sum(e over i) or mean(e over domain)";

/// A hint about the braces of LaTeX after the cursor, as in u_{xx}; may be empty.
std::string hint_of_braces(const TokenCursor& cursor) {
    const std::string_view name = cursor.text(cursor.previous());
    const bool is_subscript = cursor.previous().kind == TokenKind::name && name.size() > 1 &&
                              name.ends_with('_') && cursor.at(TokenKind::open_curly) &&
                              cursor.kind(1) == TokenKind::name &&
                              cursor.kind(2) == TokenKind::close_curly;
    if (!is_subscript) return "";
    const std::string_view of = name.substr(0, name.size() - 1);
    const std::string_view below = cursor.text(cursor.peek(1));
    const bool is_derivative = below.size() <= 2 && below.find_first_not_of("xyz") == below.npos &&
                               function_named(fmt::format("d{}", below));
    return is_derivative ? fmt::format("write 'd{}({})'", below, of)
                         : fmt::format("write '{}_{}'", of, below);
}

}  // namespace

ExpressionParser::Progress ExpressionParser::read_operator() {
    const bool on_new_line = open_brackets_ > 0 && cursor_.take_if(TokenKind::newline);
    const Token token = cursor_.peek();
    const auto is_here = [&](std::string_view word) { return cursor_.at_name(word); };
    if (open_brackets_ == 0 && std::ranges::any_of(ends_, is_here)) return Progress::finished;
    if (token.kind == TokenKind::assign) {  // Parsed as `==`, which was probably intended.
        cursor_.error(token.span, "'=' inside an expression", "write '==' to compare");
    }
    if (const auto binary = binary_of(token.kind)) {
        push_binary(*binary, cursor_.take());
        return Progress::going_on;
    }
    switch (token.kind) {
        case TokenKind::comma: return read_comma();
        case TokenKind::close_round: return read_close_round();
        case TokenKind::close_square: return read_close_round();
        case TokenKind::open_square:
            if (!begins_index()) break;
            push_bracket(PendingKind::index, cursor_.take(), {});
            return Progress::going_on;
        case TokenKind::dot:
            if (!begins_component()) break;
            return read_component();
        case TokenKind::name:
            if (open_brackets_ > 0 && cursor_.at_name("over")) return read_over();
            break;
        case TokenKind::dots:
            if (open_brackets_ == 0) return Progress::finished;
            break;
        case TokenKind::garbage: return fail_silently();
        case TokenKind::newline:
        case TokenKind::semicolon:
        case TokenKind::close_curly:
        case TokenKind::end_of_text:
            if (open_brackets_ == 0) return Progress::finished;
            if (on_new_line) cursor_.step_back();
            return unclosed();
        default: break;
    }
    return unexpected_operator(on_new_line);
}

/// Whether the '[' at the cursor directly follows a name, as in u[i]. Others begin an operand.
bool ExpressionParser::begins_index() const {
    const Token& before = cursor_.previous();
    return before.kind == TokenKind::name && before.span.end == cursor_.peek().span.begin;
}

/// Whether the '.' at the cursor directly follows a bracket or a prime, as in grad(u).x.
bool ExpressionParser::begins_component() const {
    const Token& before = cursor_.previous();
    const bool ends_operand = before.kind == TokenKind::close_round ||
                              before.kind == TokenKind::close_square ||
                              before.kind == TokenKind::prime;
    return ends_operand && before.span.end == cursor_.peek().span.begin;
}

/// Reads .x after an operand that is a vector.
ExpressionParser::Progress ExpressionParser::read_component() {
    const Token dot = cursor_.take();
    if (cursor_.at(TokenKind::garbage)) return fail_silently();
    const auto axis =
        cursor_.at(TokenKind::name) ? component_named(cursor_.text(cursor_.peek())) : std::nullopt;
    if (!axis) {
        const Span span = cursor_.at(TokenKind::name) ? cursor_.peek().span : dot.span;
        return fail(span, "a vector has only the components x, y and z", "write grad(u).x");
    }
    push_component(*axis, cursor_.word(cursor_.take()));
    return Progress::going_on;
}

/// Replaces the last operand by one of its components.
void ExpressionParser::push_component(int axis, const ast::Word& name) {
    const Operand vector = operands_.back();
    operands_.pop_back();
    const auto number = static_cast<ast::ExprId>(script_.expressions.size());
    script_.expressions.push_back({name.span, ast::Number{static_cast<double>(axis)}});
    push_operand(join(vector.outer, name.span), ast::Component{vector.id, number, name});
}

/// Reads the ']' of u[…]. If a prime follows, the operand is the rate of the member.
ExpressionParser::Progress ExpressionParser::close_index() {
    const Token close = cursor_.take();
    const Pending open = pending_.back();
    pending_.pop_back();
    --open_brackets_;
    std::optional<ast::ExprId> second;
    if (open.argument_count > 0) {
        second = operands_.back().id;
        operands_.pop_back();
    }
    const Operand index = operands_.back();
    operands_.pop_back();
    const Operand base = operands_.back();
    operands_.pop_back();
    Span whole = join(base.outer, close.span);
    if (open.is_own) {
        cursor_.skip_newlines();
        if (!cursor_.at(TokenKind::close_square)) {
            return fail(open.detail.span, "this '[' is never closed",
                        "the member of a family in this stage is written [u[i]]");
        }
        whole = join(whole, cursor_.take().span);
    } else if (cursor_.at(TokenKind::prime)) {
        ast::Expr& family = script_.expressions[base.id];
        const auto* name = std::get_if<ast::Name>(&family.node);
        if (name == nullptr) return unexpected_operator(false);
        ast::Word species{family.span, name->name};
        whole = join(whole, cursor_.take().span);
        if (cursor_.at(TokenKind::prime)) {  // u[i]'' means the rate of u_t[i].
            whole = join(whole, cursor_.take().span);
            species.text = name_of_rate(species.text);
        }
        family.node = ast::RateOf{species};
    }
    push_operand(whole, ast::Indexed{base.id, index.id, second});
    return Progress::going_on;
}

/// Reads sum(e over i). e is complete, and the cursor is at `over`.
ExpressionParser::Progress ExpressionParser::read_over() {
    reduce_above(0);
    const Token over = cursor_.peek();
    const Pending open = pending_.back();
    if (open.kind != PendingKind::call) {
        return fail(over.span, "'over' belongs inside the brackets of a function", form_of_over);
    }
    if (open.argument_count > 0) {
        return fail(over.span, "'over' must follow a single expression", form_of_over);
    }
    cursor_.take();
    cursor_.skip_newlines_in_brackets();
    if (!cursor_.at(TokenKind::name)) {
        if (cursor_.at(TokenKind::garbage)) return fail_silently();
        return fail(over.span, "'over' must be followed by an index or by 'domain'", form_of_over);
    }
    const ast::Word index = cursor_.word(cursor_.take());
    if (index.text == "near" && cursor_.at(TokenKind::open_round)) {
        push_bracket(PendingKind::near, cursor_.take(), index);
        return Progress::going_on;
    }
    return close_over(index, std::nullopt);
}

/// Closes near(d). The distance is complete, and the cursor is at the closing bracket.
ExpressionParser::Progress ExpressionParser::close_near() {
    cursor_.take();
    const ast::Word near = pending_.back().detail;
    pending_.pop_back();
    --open_brackets_;
    const ast::ExprId distance = operands_.back().id;
    operands_.pop_back();
    return close_over(near, distance);
}

/// Closes a sum at its bracket. The cursor is after the word that follows `over`.
ExpressionParser::Progress ExpressionParser::close_over(const ast::Word& over,
                                                        std::optional<ast::ExprId> distance) {
    cursor_.skip_newlines_in_brackets();
    if (!cursor_.at(TokenKind::close_round)) {
        if (cursor_.at(TokenKind::garbage)) return fail_silently();
        return fail(over.span,
                    fmt::format("a ')' is missing after 'over {}{}'", shortened(over.text),
                                distance ? "(…)" : ""),
                    form_of_over);
    }
    const Token close = cursor_.take();
    const ast::Word name = pending_.back().detail;
    pending_.pop_back();
    --open_brackets_;
    const Operand operand = operands_.back();
    operands_.pop_back();
    push_operand(join(name.span, close.span), ast::Over{name, operand.id, over, distance});
    return Progress::going_on;
}

/// Closes the innermost bracket. A `]` in place of a `)` is reported but accepted.
ExpressionParser::Progress ExpressionParser::read_close_round() {
    const Token close = cursor_.peek();
    if (open_brackets_ == 0) {
        return fail(close.span, fmt::format("this '{}' closes nothing", cursor_.text(close)));
    }
    const bool is_empty_call = expects_operand_;
    reduce_above(0);
    const Pending open = pending_.back();
    if (open.kind == PendingKind::index) {
        if (close.kind == TokenKind::close_square) return close_index();
        return fail(open.token.span, "this '[' is never closed", "a ']' is missing before the ')'");
    }
    if (close.kind == TokenKind::close_square) {
        cursor_.error({Severity::error,
                       open.token.span,
                       "this '(' is closed by ']'",
                       "write ')' there",
                       {{close.span, "the ']' is here"}}});
    }
    if (open.kind == PendingKind::near) return close_near();
    cursor_.take();
    pending_.pop_back();
    --open_brackets_;
    if (open.kind == PendingKind::group) {
        operands_.back().outer = join(open.token.span, close.span);
        return Progress::going_on;
    }
    std::uint32_t count = open.argument_count;
    if (!is_empty_call) {
        arguments_.push_back(operands_.back().id);
        operands_.pop_back();
        ++count;
    }
    const auto first = static_cast<std::uint32_t>(script_.arguments.size());
    script_.arguments.insert(script_.arguments.end(), arguments_.end() - count, arguments_.end());
    arguments_.resize(arguments_.size() - count);
    push_operand(join(open.detail.span, close.span), ast::Call{open.detail, first, count});
    return Progress::going_on;
}

ExpressionParser::Progress ExpressionParser::read_comma() {
    if (open_brackets_ == 0) return Progress::finished;
    reduce_above(0);
    Pending& open = pending_.back();
    if (open.kind == PendingKind::index) {
        if (open.argument_count > 0) {
            return fail(cursor_.peek().span, "a family has at most two indices", "write A[i, j]");
        }
        cursor_.take();
        ++open.argument_count;
        expects_operand_ = true;
        return Progress::going_on;
    }
    if (open.kind == PendingKind::near) {
        return fail(cursor_.peek().span, "'near' takes one distance", form_of_near);
    }
    if (open.kind == PendingKind::group) {
        return fail(cursor_.peek().span, "',' can separate only the arguments of a function",
                    "write a list without brackets, or a vector as vector(1, 0)");
    }
    cursor_.take();
    arguments_.push_back(operands_.back().id);
    operands_.pop_back();
    ++open.argument_count;
    expects_operand_ = true;
    return Progress::going_on;
}

/// Reports a token that is neither an operator nor the end of an expression.
ExpressionParser::Progress ExpressionParser::unexpected_operator(bool on_new_line) {
    const Token token = cursor_.peek();
    switch (token.kind) {
        case TokenKind::prime:
            return fail(token.span, "a prime directly follows a name", "write p' for a rate");
        case TokenKind::dot:
            return fail(token.span, "'.' joins the name of a stage and one of its names",
                        cursor_.behind(2).kind == TokenKind::dot &&
                                cursor_.kind(2) == TokenKind::open_round
                            ? "a function cannot be called on an object or a module"
                            : "write stage.p");
        case TokenKind::colon:
        case TokenKind::dots:
        case TokenKind::plus_assign:
        case TokenKind::open_curly: {
            const bool is_axis = token.kind == TokenKind::colon && open_brackets_ == 0 &&
                                 component_named(cursor_.text(cursor_.previous()));
            return fail(token.span, cursor_.describe(token) + " has no place inside an expression",
                        is_axis ? "write the values in the order of the axes, as in boundary: "
                                  "periodic, noflux"
                                : hint_of_braces(cursor_));
        }
        default: return missing_operator(on_new_line);
    }
}

/// Whether the cursor is between an operator such as (1 + lap)^2 and an operand.
bool ExpressionParser::begins_applied() {
    const TokenKind here = cursor_.kind();
    const bool begins = here == TokenKind::name || here == TokenKind::number ||
                        here == TokenKind::open_round || here == TokenKind::open_square;
    if (!begins || cursor_.previous().kind == TokenKind::name) return false;
    reduce_above(info(Function::multiply).precedence);
    return applies_operator(script_, operands_.back().id);
}

/// Reports two operands without an operator between them.
ExpressionParser::Progress ExpressionParser::missing_operator(bool on_new_line) {
    const Token before = cursor_.previous();
    const Token here = cursor_.peek();
    if (on_new_line) {
        cursor_.step_back();
        return unclosed();
    }
    if (before.kind == TokenKind::garbage) return fail_silently();
    const bool is_statement = cursor_.begins_statement();
    if (is_statement && open_brackets_ > 0) return unclosed();
    if (is_statement) {
        cursor_.error(here.span, cursor_.describe(here) + " begins a second statement on this line",
                      "put ';' between them");
        return Progress::finished;
    }
    if (cursor_.at_name("over")) {
        return fail(here.span, "'over' belongs inside the brackets of a function",
                    "write sum(e over i) or mean(e over domain)");
    }
    if (begins_applied()) {
        push_binary(Function::multiply, before);
        return Progress::going_on;
    }
    const auto is_if = [&](const Token& token) {
        return token.kind == TokenKind::name && cursor_.text(token) == "if";
    };
    const auto fail_here = [&](std::string hint) {
        return fail(here.span, "an operator is missing before " + cursor_.describe(here),
                    std::move(hint));
    };
    const ast::Expr& left = script_.expressions[operands_.back().id];
    const auto* const call = std::get_if<ast::Call>(&left.node);
    const bool is_condition = call && call->function.text == "if" && call->argument_count == 1;
    if (is_if(here) || is_if(before) || is_condition) {
        return fail_here("a choice is written if(condition, a, b)");
    }
    if (const auto form = foreign_form(); !form.hint.empty()) {
        return fail(form.span, form.message, form.hint);
    }
    if (before.kind == TokenKind::number && here.kind == TokenKind::number) {
        return fail_here(fmt::format("write '{0} * {1}' to multiply, '{0}, {1}' for two values",
                                     cursor_.text(before), cursor_.text(here)));
    }
    if (before.kind == TokenKind::number && here.kind == TokenKind::name) {
        const std::string_view word = cursor_.text(here), number = cursor_.text(before);
        std::string advice = cursor_.declares(word) ? "" : advice_about_unit(number, word);
        if (word == "to") advice = "a range is written 0 .. 1";
        if (!advice.empty()) return fail_here(std::move(advice));
    }
    return fail_here(hint_of_missing_operator());
}

/// Skips the rest of the statement after an error that the lexer has reported.
ExpressionParser::Progress ExpressionParser::fail_silently() {
    cursor_.skip_statement(open_brackets_);
    return Progress::failed;
}

}  // namespace cascade
