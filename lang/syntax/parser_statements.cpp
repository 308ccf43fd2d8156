// Parses statements: a name, a relation, and one or more expressions.
#include "lang/syntax/script_parser.h"

#include "core/side.h"
#include "lang/syntax/kept_spellings.h"
#include "lang/syntax/second_rates.h"
#include "lang/vocabulary/settings.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace cascade {

namespace {

/// Words that end a value if they are written where an operator could be.
constexpr std::array<std::string_view, 2> ends_of_value{"in", "after"};

}  // namespace

/// Parses the statement at the cursor and moves to its end. If the name or the relation is wrong,
/// reports an error and returns nullopt. A wrong value becomes Garbage.
std::optional<ast::Statement> ScriptParser::parse_statement() {
    if (!cursor_.at(TokenKind::name) && !cursor_.begins_constraint()) {
        report_no_statement();
        return std::nullopt;
    }
    ast::Statement statement;
    const bool is_constraint = cursor_.begins_constraint();
    statement.doc = docs_before();
    statement.name = cursor_.word(cursor_.take());
    if (!is_constraint && !parse_index(statement)) return std::nullopt;
    parse_side(statement);
    if (!parse_relation(statement)) return std::nullopt;
    if (is_constraint) statement.kind = ast::StatementKind::constraint;
    parse_values(statement);
    statement.span = join(statement.name.span, cursor_.previous().span);
    add_docs(statement.doc, docs_after(statement.name.span.begin));
    return statement;
}

/// Parses the `.left` of `u.left: e` or `u[1].left: e`, if there is one.
void ScriptParser::parse_side(ast::Statement& statement) {
    const bool is_dotted = cursor_.at(TokenKind::dot) && cursor_.kind(1) == TokenKind::name &&
                           cursor_.kind(2) == TokenKind::colon &&
                           cursor_.peek().span.begin == cursor_.previous().span.end &&
                           cursor_.peek(1).span.begin == cursor_.peek().span.end;
    if (!is_dotted) return;
    const std::string_view word = cursor_.text(cursor_.peek(1));
    const bool is_side = word == "sides" ||
                         std::find(side_names.begin(), side_names.end(), word) != side_names.end();
    if (!is_side) return;
    cursor_.take();
    statement.side = cursor_.word(cursor_.take());
}

/// Adds a statement to a block. Statements about sides go into a separate list.
void ScriptParser::add_statement(ast::Block& block, ast::Statement statement) {
    if (!statement.after.empty() && !block.is_cells) {
        cursor_.error(statement.after.span, "only cells that crawl divide",
                      "'after divide' belongs in a block 'cells NAME { … }'");
    }
    (!statement.side.empty() ? block.sides : block.statements).push_back(std::move(statement));
}

std::string ScriptParser::docs_before() {
    return cursor_.take_docs(cursor_.taken_up_to(), cursor_.peek().span.begin);
}

std::string ScriptParser::docs_after(std::uint32_t begin) {
    const bool is_last = cursor_.at(TokenKind::semicolon) && cursor_.kind(1) == TokenKind::newline;
    return cursor_.take_docs(begin, cursor_.peek(is_last ? 1 : 0).span.begin);
}

void ScriptParser::add_docs(std::string& doc, const std::string& more) {
    if (!doc.empty() && !more.empty()) doc += ' ';
    doc += more;
}

/// Parses the `[i]` of `u[i]: e`, if there is one. Reports an error and returns false if the index
/// is wrong.
bool ScriptParser::parse_index(ast::Statement& statement) {
    const bool is_index =
        cursor_.at(TokenKind::open_square) && cursor_.peek().span.begin == statement.name.span.end;
    if (!is_index) return true;
    const Token open = cursor_.take();
    const auto is_word = [&](std::size_t ahead) {
        return cursor_.kind(ahead) == TokenKind::name || cursor_.kind(ahead) == TokenKind::number;
    };
    if (is_word(0) && cursor_.kind(1) == TokenKind::close_square) {
        statement.index = cursor_.word(cursor_.take());
        cursor_.take();
        return true;
    }
    if (is_word(0) && cursor_.kind(1) == TokenKind::comma && is_word(2) &&
        cursor_.kind(3) == TokenKind::close_square) {
        const ast::Word first = cursor_.word(cursor_.take());
        cursor_.take();
        const ast::Word second = cursor_.word(cursor_.take());
        cursor_.take();
        statement.index = {join(first.span, second.span),
                           kept_spelling(fmt::format("{},{}", first.text, second.text))};
        return true;
    }
    if (!cursor_.at(TokenKind::garbage)) {
        cursor_.error(join(statement.name.span, open.span),
                      "the index in this statement must be a name or a whole number",
                      hint_of_index(shortened(statement.name.text)));
    }
    cursor_.skip_statement(1);
    return false;
}

/// Parses the relation between the name and the value, such as `:` or `=`. Relations of other
/// languages are reported, and then read as the relations of Cascade that they mean. Returns false
/// if there is no value to parse.
bool ScriptParser::parse_relation(ast::Statement& statement) {
    using Kind = ast::StatementKind;
    const Token token = cursor_.peek();
    const std::string name(shortened(statement.name.text));
    switch (token.kind) {
        case TokenKind::colon: statement.kind = Kind::value; break;
        case TokenKind::assign: statement.kind = Kind::definition; break;
        case TokenKind::greater_equal: statement.kind = Kind::at_least; break;
        case TokenKind::less_equal: statement.kind = Kind::at_most; break;
        case TokenKind::prime: cursor_.take(); return parse_rate_relation(statement);
        case TokenKind::plus_assign:
            statement.kind = Kind::rate_term;
            cursor_.error(token.span, "a term can be added only to a rate",
                          fmt::format("write {}' +=", name));
            break;
        case TokenKind::equal:
            statement.kind = Kind::definition;
            cursor_.error(token.span, "'==' compares two values but does not define a name",
                          "write '='");
            break;
        case TokenKind::greater:
            statement.kind = Kind::at_least;
            cursor_.error(token.span, "a bound is written with '>='", "write '>='");
            break;
        case TokenKind::less:
            statement.kind = Kind::at_most;
            cursor_.error(token.span, "a bound is written with '<='", "write '<='");
            break;
        case TokenKind::dot:
            report_dot(statement);
            cursor_.skip_statement();
            return false;
        case TokenKind::garbage: cursor_.skip_statement(); return false;
        default: return take_paper_rate(statement) || report_missing_colon(statement);
    }
    cursor_.take();
    return true;
}

bool ScriptParser::parse_rate_relation(ast::Statement& statement) {
    if (cursor_.at(TokenKind::prime)) {
        cursor_.take();
        statement.second = statement.name;
        statement.name.text = name_of_rate(statement.name.text);
    }
    if (cursor_.take_if(TokenKind::plus_assign)) {
        statement.kind = ast::StatementKind::rate_term;
        return true;
    }
    statement.kind = ast::StatementKind::rate;
    if (cursor_.take_if(TokenKind::assign)) return true;
    if (cursor_.at(TokenKind::prime)) return report_third_rate(statement);
    if (!cursor_.at(TokenKind::garbage)) {
        cursor_.error(join(statement.name.span, cursor_.previous().span),
                      "a rate is written with '=' or '+='",
                      fmt::format("write {}' = …", shortened(statement.name.text)));
    }
    // The colon is probably a mistake, and the rate follows it.
    if (cursor_.take_if(TokenKind::colon) || cursor_.take_if(TokenKind::equal)) return true;
    cursor_.skip_statement();
    return false;
}

/// Parses one expression or several expressions separated by commas.
void ScriptParser::parse_values(ast::Statement& statement) {
    const bool colon_is_missing =
        !wants_operand(cursor_.previous().kind) && cursor_.previous().kind != TokenKind::colon;
    const std::string owner =
        fmt::format("the {} of {}",
                    statement.kind == ast::StatementKind::value        ? "value"
                    : statement.kind == ast::StatementKind::definition ? "definition"
                    : statement.kind == ast::StatementKind::constraint ? "right side"
                    : statement.kind == ast::StatementKind::rate ||
                            statement.kind == ast::StatementKind::rate_term
                        ? "rate"
                        : "bound",
                    cursor_.describe({TokenKind::name, statement.name.span}));
    cursor_.mute(colon_is_missing);
    if (statement.kind == ast::StatementKind::value) skip_type(statement.name);
    statement.values.push_back(parse_after_operator(owner, ends_of_value));
    if (cursor_.at(TokenKind::dots)) parse_end_of_index(statement);
    if (statement.kind == ast::StatementKind::index &&
        is_setting_of(SettingBlock::domain, statement.name.text)) {
        parse_more_ranges(statement);
    }
    while (cursor_.at(TokenKind::comma)) {
        const Token comma = cursor_.take();
        if (cursor_.begins_statement()) {
            cursor_.error(comma.span, "a comma separates values, not statements", "write ';'");
            break;
        }
        if (statement.kind == ast::StatementKind::definition &&
            is_setting_of(SettingBlock::domain, statement.name.text)) {
            cursor_.error(statement.name.span, "a setting has ':' before its values",
                          fmt::format("write '{}: …'", statement.name.text));
            statement.kind = ast::StatementKind::value;
        }
        if (statement.kind != ast::StatementKind::value) {
            cursor_.error(comma.span, "only a value (name: …) may be a list",
                          "write one expression");
            cursor_.skip_statement();
            break;
        }
        const bool ends = cursor_.at(TokenKind::newline)
                              ? cursor_.begins_statement(1) ||
                                    cursor_.kind(1) == TokenKind::close_curly ||
                                    cursor_.kind(1) == TokenKind::end_of_text
                              : cursor_.at_statement_end();
        if (ends) {
            cursor_.error(comma.span, "a value is missing after this ','", "leave the ',' out");
            break;
        }
        if (cursor_.at(TokenKind::newline)) cursor_.take();
        statement.values.push_back(expressions_.parse(owner, ends_of_value));
    }
    if (cursor_.at_name("in")) parse_range(statement);
    if (cursor_.at_name("after")) parse_after(statement);
    if (cursor_.at(TokenKind::dots)) {
        cursor_.error(cursor_.peek().span, "'..' has no place here",
                      "a range is written 1..3, or p: 1 in 0 .. 2");
        cursor_.skip_statement();
    }
    cursor_.mute(false);
}

/// Parses an expression after an operator or a ':'. The expression may begin on the next line,
/// except after a ':'.
ast::Expression ScriptParser::parse_after_operator(const std::string& owner,
                                                   std::span<const std::string_view> ends) {
    const bool goes_on = wants_operand(cursor_.previous().kind) && cursor_.at(TokenKind::newline) &&
                         !cursor_.begins_statement(1) && cursor_.kind(1) != TokenKind::close_curly;
    if (goes_on) cursor_.take();
    return expressions_.parse(owner, ends);
}

}  // namespace cascade
