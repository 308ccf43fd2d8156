// The parser of expressions. It works by operator precedence with explicit stacks (E. W. Dijkstra's
// "shunting yard", Mathematisch Centrum report MR 35, 1961), so that deep nesting needs memory but
// no recursion.
//
// The operators, from the loosest to the tightest: or · and · not · comparisons · + - · * / · unary
// minus · ^ (right-associative).
#pragma once

#include "lang/syntax/ast.h"
#include "lang/syntax/token_cursor.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Parses expressions at the cursor and appends their nodes to a script.
class ExpressionParser {
public:
    ExpressionParser(TokenCursor& cursor, ast::Script& script) : cursor_(cursor), script_(script) {}

    /// Parses one expression. Leaves the cursor at the end of the expression: at a line break, `;`,
    /// `}`, `,` or the end of the text. Reports an error, if there is one, skips to the end of the
    /// statement and returns Garbage. If the value is missing, `owner` describes it in the message:
    /// `the value of 'ka'`. Outside of brackets the expression also ends at `..`, and at a word of
    /// `ends` where an operator could be.
    ast::Expression parse(const std::string& owner, std::span<const std::string_view> ends = {});

private:
    enum class PendingKind : std::uint8_t { binary, unary, group, call, index, near };
    /// Whether the left side of a comparison is itself a comparison, as in `0 < a < 4`.
    enum class Chain : std::uint8_t { none, to_report, reported };
    enum class Progress : std::uint8_t { going_on, finished, failed };

    /// An operator or an open bracket whose right side has not been read to its end yet.
    struct Pending {
        PendingKind kind = PendingKind::group;
        Chain chain = Chain::none;
        Function op{};
        Token token;       ///< The operator or the bracket.
        ast::Word detail;  ///< The name of a call, `near`, or the middle operand of an operator.
        std::uint32_t argument_count = 0;  ///< For a call, the number of complete arguments.
        bool is_own = false;  ///< For an index, whether it is the inner bracket in [u[i]].
        int precedence() const { return info(op).precedence; }
        bool is_bracket() const {
            return kind == PendingKind::group || kind == PendingKind::call ||
                   kind == PendingKind::index || kind == PendingKind::near;
        }
    };
    /// A complete operand. `outer` is its source location, including brackets around it.
    struct Operand {
        ast::ExprId id = 0;
        Span outer;
    };

    Progress read_operand();
    Progress read_name();
    Progress read_number();
    Progress read_unit();
    Progress read_bracketed();
    Progress read_own_member();
    Progress read_not();
    Progress read_text_in_primes();
    Progress missing_operand();

    Progress read_operator();
    Progress read_close_round();
    Progress close_index();
    Progress read_comma();
    Progress read_over();
    Progress close_near();
    Progress close_over(const ast::Word& over, std::optional<ast::ExprId> distance);
    bool begins_index() const;
    bool begins_component() const;
    Progress read_component();
    void push_component(int axis, const ast::Word& name);
    Progress unexpected_operator(bool on_new_line);
    std::string hint_of_missing_operator() const;
    /// An error about a form that other languages have. The hint may be empty.
    struct ForeignForm {
        Span span;
        std::string message, hint;
    };
    ForeignForm foreign_form() const;
    Progress missing_operator(bool on_new_line);
    bool begins_applied();
    Progress unclosed();
    Progress fail(Span span, std::string message, std::string hint = "");
    Progress fail_silently();

    void push_operand(Span span, decltype(ast::Expr::node) node);
    void push_bracket(PendingKind kind, Token bracket, ast::Word name);
    void push_binary(Function op, const Token& sign);
    void reduce_above(int precedence);
    void reduce();
    void report_chain(const Pending& comparison, const Operand& left, const Operand& right);
    ast::Expression finish();
    ast::Expression abandon(Span begin);

    TokenCursor& cursor_;
    ast::Script& script_;
    std::string owner_;
    std::span<const std::string_view> ends_;
    ast::ExprId first_ = 0;
    std::uint32_t first_argument_ = 0;
    std::vector<Pending> pending_;
    std::vector<Operand> operands_;
    std::vector<ast::ExprId> arguments_;  ///< The complete arguments of the calls in `pending_`.
    std::size_t open_brackets_ = 0;
    bool expects_operand_ = true;
};

}  // namespace cascade
