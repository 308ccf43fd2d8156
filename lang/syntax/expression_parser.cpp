// Parses expressions: the main loop, the reduction of operators that have all their operands, and
// the hint for a missing operator.
#include "lang/syntax/expression_parser.h"

#include "core/check.h"
#include "lang/vocabulary/functions.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <fmt/core.h>

#include <utility>

namespace cascade {

ast::Expression ExpressionParser::parse(const std::string& owner,
                                        std::span<const std::string_view> ends) {
    owner_ = owner;
    ends_ = ends;
    first_ = static_cast<ast::ExprId>(script_.expressions.size());
    first_argument_ = static_cast<std::uint32_t>(script_.arguments.size());
    pending_.clear();
    operands_.clear();
    arguments_.clear();
    open_brackets_ = 0;
    expects_operand_ = true;
    const Span begin = cursor_.peek().span;
    while (true) {
        switch (expects_operand_ ? read_operand() : read_operator()) {
            case Progress::going_on: break;
            case Progress::finished: return finish();
            case Progress::failed: return abandon(begin);
        }
    }
}

void ExpressionParser::push_operand(Span span, decltype(ast::Expr::node) node) {
    operands_.push_back({static_cast<ast::ExprId>(script_.expressions.size()), span});
    script_.expressions.push_back({span, std::move(node)});
    expects_operand_ = false;
}

void ExpressionParser::push_bracket(PendingKind kind, Token bracket, ast::Word name) {
    Pending open;
    open.kind = kind;
    open.token = bracket;
    open.detail = name;
    pending_.push_back(open);
    ++open_brackets_;
    expects_operand_ = true;
}

/// Reduces pending operators that bind more tightly than `op`, and then pushes `op`.
void ExpressionParser::push_binary(Function op, const Token& sign) {
    Pending pending;
    pending.kind = PendingKind::binary;
    pending.op = op;
    pending.token = sign;
    reduce_above(pending.precedence());
    const bool meets_equal = !pending_.empty() && pending_.back().kind == PendingKind::binary &&
                             pending_.back().precedence() == pending.precedence();
    if (meets_equal && is_comparison(op)) {
        pending.chain = pending_.back().chain == Chain::none ? Chain::to_report : Chain::reported;
        pending.detail.span = operands_.back().outer;
    }
    if (meets_equal && op != Function::power) reduce();
    pending_.push_back(pending);
    expects_operand_ = true;
}

/// Reduces the pending operators that bind more tightly than `precedence`. Stops at the last open
/// bracket.
void ExpressionParser::reduce_above(int precedence) {
    while (!pending_.empty() && !pending_.back().is_bracket() &&
           pending_.back().precedence() > precedence) {
        reduce();
    }
}

/// Turns the last pending operator and its operands into one operand.
void ExpressionParser::reduce() {
    const Pending pending = pending_.back();
    pending_.pop_back();
    const Operand right = operands_.back();
    operands_.pop_back();
    if (pending.kind == PendingKind::unary) {
        push_operand(join(pending.token.span, right.outer), ast::Unary{pending.op, right.id});
        return;
    }
    CHECK(pending.kind == PendingKind::binary && !operands_.empty(), "brackets are not reduced");
    const Operand left = operands_.back();
    operands_.pop_back();
    if (pending.chain == Chain::to_report) report_chain(pending, left, right);
    push_operand(join(left.outer, right.outer), ast::Binary{pending.op, left.id, right.id});
}

void ExpressionParser::report_chain(const Pending& comparison, const Operand& left,
                                    const Operand& right) {
    const Span whole = join(left.outer, right.outer);
    std::string hint = "join two comparisons by 'and'";
    constexpr std::size_t longest = 50;
    const std::string_view text = cursor_.text(whole);
    if (text.size() <= longest && text.find_first_of("\r\n#") == std::string_view::npos) {
        hint = fmt::format("write '{} and {} {} {}'", cursor_.text(left.outer),
                           cursor_.text(comparison.detail.span), cursor_.text(comparison.token),
                           cursor_.text(right.outer));
    }
    cursor_.error(whole, "two comparisons cannot be chained", hint);
}

ast::Expression ExpressionParser::finish() {
    while (!pending_.empty()) reduce();
    CHECK(operands_.size() == 1, "operators and operands of an expression come out even");
    return {first_, operands_.back().id};
}

/// Replaces an expression with errors by Garbage.
ast::Expression ExpressionParser::abandon(Span begin) {
    auto& expressions = script_.expressions;
    expressions.erase(expressions.begin() + first_, expressions.end());
    script_.arguments.resize(first_argument_);
    const Span end = cursor_.previous().span;
    expressions.push_back({end.end >= begin.end ? join(begin, end) : begin, ast::Garbage{}});
    return {first_, first_};
}

/// Reports an error and skips the rest of the statement.
ExpressionParser::Progress ExpressionParser::fail(Span span, std::string message,
                                                  std::string hint) {
    cursor_.error(span, std::move(message), std::move(hint));
    cursor_.skip_statement(open_brackets_);
    return Progress::failed;
}

/// Reports the innermost bracket that is still open at the end of the statement.
ExpressionParser::Progress ExpressionParser::unclosed() {
    for (std::size_t k = pending_.size(); k-- > 0;) {
        if (!pending_[k].is_bracket()) continue;
        // An unclosed string may contain the closing bracket.
        if (cursor_.lost_in_text(pending_[k].token, "")) break;
        const bool is_index = pending_[k].kind == PendingKind::index;
        cursor_.error(pending_[k].token.span,
                      is_index ? "this '[' is never closed" : "this '(' is never closed",
                      fmt::format("a '{}' is missing before the statement ends",
                                  is_index ? ']' : ')'));
        break;
    }
    cursor_.skip_statement();
    return Progress::failed;
}

/// Describes the forms `16 x 16`, `tanh^2(u)`, `u.lap()`, `np.exp(u)` and `c . grad(u)` of other
/// languages, if one of them is where an operator is missing.
ExpressionParser::ForeignForm ExpressionParser::foreign_form() const {
    const Token &one = cursor_.behind(1), two = cursor_.behind(2), three = cursor_.behind(3);
    const Token here = cursor_.peek(), next = cursor_.peek(1);
    const std::string missing = "an operator is missing before " + cursor_.describe(here);
    const bool is_cross =
        here.kind == TokenKind::name && (cursor_.text(here) == "x" || cursor_.text(here) == "X");
    if (one.kind == TokenKind::number && is_cross && next.kind == TokenKind::number) {
        const bool is_list = pending_.empty() && cursor_.kind(2) != TokenKind::caret;
        return {join(one.span, next.span), missing,
                fmt::format("write '{}{}{}'", cursor_.text(one), is_list ? ", " : " * ",
                            cursor_.text(next))};
    }
    const bool begins_argument = here.kind == TokenKind::open_round || here.kind == TokenKind::name;
    if (begins_argument && one.kind == TokenKind::number && two.kind == TokenKind::caret &&
        three.kind == TokenKind::name && function_named(cursor_.text(three))) {
        return {here.span, missing,
                fmt::format("write {}(…)^{}", cursor_.text(three), cursor_.text(one))};
    }
    const bool is_path = here.kind == TokenKind::open_round && one.kind == TokenKind::name &&
                         two.kind == TokenKind::dot && three.kind == TokenKind::name;
    if (!is_path) return {};
    const std::string_view function = cursor_.text(one);
    const std::string object = shortened(cursor_.text(three));
    if (two.span.begin > three.span.end) {
        return {join(three.span, one.span), "'.' joins the name of a stage and one of its names",
                fmt::format("dot({}, …) is the product of vectors", object)};
    }
    if (next.kind == TokenKind::close_round && function_named(function)) {
        return {join(three.span, next.span), missing,
                fmt::format("write '{}({})'", function, object)};
    }
    return {join(three.span, two.span), "a function cannot be called on an object or a module",
            fmt::format("leave '{}.' out", object)};
}

/// A hint about the operator that is missing between two operands; may be empty.
std::string ExpressionParser::hint_of_missing_operator() const {
    const Token before = cursor_.previous();
    const Token here = cursor_.peek();
    const Span both = join(before.span, here.span);
    const bool is_bar =
        here.kind == TokenKind::name && cursor_.text(here) != cursor_.text(here.span);
    // Where no formula is expected, words such as "periodic noflux" are not factors of a product.
    const bool is_in_formula = !pending_.empty() || cursor_.kind(1) == TokenKind::open_round;
    const bool is_product =
        before.kind == TokenKind::number || here.kind == TokenKind::open_round ||
        (before.kind == TokenKind::name && is_in_formula) ||
        (before.kind == TokenKind::close_round && here.kind != TokenKind::open_square) ||
        (is_bar && before.kind != TokenKind::keyword_not);
    if (before.kind == TokenKind::name && here.kind == TokenKind::name) {
        const std::string_view function = cursor_.text(before);
        const bool is_plain = !is_bar && !function_named(cursor_.text(here));
        if (function_named(function)) {
            return fmt::format("write {}({})", function,
                               is_plain ? shortened(cursor_.text(here)) : "…");
        }
        const std::string_view advice = advice_about(function, WordContext::function);
        if (!advice.empty()) return std::string(advice);
    }
    if (cursor_.at_name("in") || cursor_.at_name("step")) {
        return "a range follows the value of a parameter: p: 1 in 0 .. 2 step 0.1";
    }
    if (is_product && here.kind != TokenKind::keyword_not && both.end - both.begin <= 40) {
        const bool is_as_written = cursor_.text(before) == cursor_.text(before.span);
        const bool is_after_bracket = before.kind == TokenKind::close_round;
        if (here.kind == TokenKind::open_round || is_after_bracket || !is_as_written || is_bar) {
            return "write '*' to multiply";
        }
        return fmt::format("write '{} * {}' to multiply", cursor_.text(before), cursor_.text(here));
    }
    return "";
}

}  // namespace cascade
