// Parses the parts of a statement that follow a value: the end of an index, the range of a
// parameter, and `after divide`.
#include "lang/syntax/script_parser.h"
#include "lang/syntax/script_units.h"

#include <fmt/core.h>

#include <array>

namespace cascade {

namespace {

// Words that end a part of a range if they are written where an operator could be.
constexpr std::array<std::string_view, 2> ends_of_range{"step", "after"};
constexpr std::array<std::string_view, 1> ends_of_step{"after"};

}  // namespace

/// Parses the `.. high` of `i: low .. high`.
void ScriptParser::parse_end_of_index(ast::Statement& statement) {
    const Token dots = cursor_.take();
    if (statement.kind != ast::StatementKind::value || !statement.index.empty()) {
        cursor_.error(dots.span, "a range '..' can only declare an index", "write i: 1..3");
        cursor_.skip_statement();
        return;
    }
    statement.kind = ast::StatementKind::index;
    statement.values.push_back(expressions_.parse("the end of the range"));
}

/// Parses the ranges after the first range of `extent: 0 .. 10, 0 .. 10`, so that the checker can
/// report all of them together.
void ScriptParser::parse_more_ranges(ast::Statement& statement) {
    while (cursor_.at(TokenKind::comma) && !cursor_.begins_statement(1)) {
        cursor_.take();
        for (const char* end : {"the beginning of the range", "the end of the range"}) {
            statement.values.push_back(expressions_.parse(end));
            if (!cursor_.take_if(TokenKind::dots)) break;
        }
    }
}

/// Parses the `in low .. high [step e]` after a value, if there is one.
void ScriptParser::parse_range(ast::Statement& statement) {
    const Token word = cursor_.take();
    const std::string form = "write p: 1 in 0 .. 2";
    if (statement.kind != ast::StatementKind::value || statement.values.size() != 1) {
        cursor_.error(word.span, "only the value of a parameter has a range", form);
        cursor_.skip_statement();
        return;
    }
    ast::Range range;
    // If a number has no unit, it gets the unit of the value.
    const std::string_view unit = unit_text_of(script_, statement.values[0]);
    range.low = expressions_.parse("the lower end of the range");
    give_unit(script_, range.low, unit);
    if (!cursor_.at(TokenKind::dots)) {
        const auto& low = script_.expressions[range.low.root].node;
        if (!std::holds_alternative<ast::Garbage>(low)) {
            cursor_.error(word.span, "a range has two ends with '..' between them", form);
        }
        cursor_.skip_statement();
        return;
    }
    cursor_.take();
    range.high = expressions_.parse("the upper end of the range", ends_of_range);
    give_unit(script_, range.high, unit);
    if (cursor_.at_name("step")) {
        cursor_.take();
        range.step = expressions_.parse("the step of the range", ends_of_step);
        give_unit(script_, *range.step, unit);
    }
    range.span = join(word.span, cursor_.previous().span);
    statement.range = range;
}

/// Parses the `after divide` after a value and its range, if there is one.
void ScriptParser::parse_after(ast::Statement& statement) {
    const Token word = cursor_.take();
    const std::string form = fmt::format("write {}: 0 after divide", statement.name.text);
    if (statement.kind != ast::StatementKind::value || statement.values.size() != 1) {
        cursor_.error(word.span, "'after divide' can follow only a starting value", form);
        cursor_.skip_statement();
        return;
    }
    if (!cursor_.at_name("divide")) {
        if (!cursor_.at(TokenKind::garbage)) {
            cursor_.error(word.span, "'after' must be followed by 'divide'", form);
        }
        cursor_.skip_statement();
        return;
    }
    statement.after = cursor_.word(cursor_.take());
    if (cursor_.at_statement_end()) return;
    cursor_.error(cursor_.peek().span,
                  fmt::format("{} has no place after 'divide'", cursor_.describe(cursor_.peek())));
    cursor_.skip_statement();
}

}  // namespace cascade
