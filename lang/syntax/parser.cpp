// The entry points of the parser.
#include "lang/syntax/parse.h"

#include "lang/syntax/script_parser.h"
#include "lang/syntax/script_units.h"

#include <fmt/core.h>

#include <algorithm>

namespace cascade {

namespace {

/// Whether a text has at most the size that scripts may have. Otherwise reports an error.
bool has_sane_size(SourceId source, const Sources& sources, Diagnostics& diagnostics) {
    const std::size_t size = sources[source].text().size();
    if (size <= largest_script) return true;
    diagnostics.error({source, 0, 0},
                      fmt::format("this script has {} bytes, but at most {} can be read", size,
                                  largest_script));
    return false;
}

}  // namespace

ast::Script parse(SourceId source, const Sources& sources, Diagnostics& diagnostics) {
    ast::Script script;
    if (!has_sane_size(source, sources, diagnostics)) return script;
    const std::size_t errors_before = diagnostics.error_count();
    TokenCursor cursor(source, sources, diagnostics);
    while (cursor.take_if(TokenKind::newline) || cursor.take_if(TokenKind::semicolon)) {
    }
    if (cursor.at_end()) {
        if (diagnostics.error_count() == errors_before) {
            diagnostics.error({source, 0, 0}, "this script is empty",
                              "a script begins with 'system_name: turing_spots', for example");
        }
        return script;
    }
    script.expressions.reserve(cursor.token_count());
    ScriptParser(cursor, script).parse_script();
    // After an error, lost doc comments are not reported, because they may belong to text that
    // could not be parsed.
    if (diagnostics.error_count() == errors_before) cursor.report_lost_docs();
    return script;
}

void parse_used(SourceId source, const Sources& sources, ast::Script& script,
                Diagnostics& diagnostics) {
    if (!has_sane_size(source, sources, diagnostics)) return;
    const std::size_t errors_before = diagnostics.error_count();
    const auto blocks_before = static_cast<std::ptrdiff_t>(script.blocks.size());
    TokenCursor cursor(source, sources, diagnostics);
    ScriptParser(cursor, script).parse_script();
    if (diagnostics.error_count() == errors_before) cursor.report_lost_docs();
    script.blocks.erase(std::remove_if(script.blocks.begin() + blocks_before, script.blocks.end(),
                                       [](const ast::Block& block) {
                                           return block.kind != ast::BlockKind::system &&
                                                  block.kind != ast::BlockKind::shape;
                                       }),
                        script.blocks.end());
}

std::optional<ast::Expression> parse_expression(SourceId source, const Sources& sources,
                                                ast::Script& script, Diagnostics& diagnostics) {
    if (!has_sane_size(source, sources, diagnostics)) return std::nullopt;
    const std::size_t errors_before = diagnostics.error_count();
    TokenCursor cursor(source, sources, diagnostics);
    const auto expression = ScriptParser(cursor, script).parse_lone_expression();
    return diagnostics.error_count() == errors_before ? expression : std::nullopt;
}

void parse_override(SourceId source, const Sources& sources, ast::Script& script,
                    Diagnostics& diagnostics) {
    if (!has_sane_size(source, sources, diagnostics)) return;
    TokenCursor cursor(source, sources, diagnostics);
    ScriptParser(cursor, script).parse_override();
}

/// Reports text after the end of the expression, unless an error in the expression has been
/// reported.
void ScriptParser::report_rest(const std::string& what, ast::Expression expression,
                               const std::string& hint) {
    cursor_.skip_newlines();
    const auto& root = script_.expressions[expression.root].node;
    if (cursor_.at_end() || std::holds_alternative<ast::Garbage>(root)) return;
    cursor_.error(cursor_.peek().span,
                  fmt::format("{} ends before {}", what, cursor_.describe(cursor_.peek())), hint);
}

std::optional<ast::Expression> ScriptParser::parse_lone_expression() {
    cursor_.skip_newlines();
    if (cursor_.at_end()) {
        cursor_.error(cursor_.peek().span, "an expression is missing");
        return std::nullopt;
    }
    const ast::Expression expression = expressions_.parse("the expression");
    report_rest("one expression", expression,
                cursor_.at(TokenKind::comma) ? "several expressions take a --panel each" : "");
    return expression;
}

/// Parses the word after a '.', if there is a '.'. Reports an error and returns false if the word
/// is missing.
bool ScriptParser::parse_word_after_dot(ast::Word& word, const std::string& form) {
    if (!cursor_.take_if(TokenKind::dot)) return true;
    if (!cursor_.at(TokenKind::name)) {
        cursor_.error(cursor_.previous().span, "a name is missing after '.'", form);
        return false;
    }
    word = cursor_.word(cursor_.take());
    return true;
}

/// Parses name=value, stage.name=value, and the sides u.left=… and stage.u.left=…, where u may be
/// u[1]. The checker decides whether a.left is a side of species a or a parameter of stage a.
void ScriptParser::parse_override() {
    const std::string form = "write name=value or stage.name=value";
    ast::Override change;
    ast::Statement& statement = change.statement;
    cursor_.skip_newlines();
    if (!cursor_.at(TokenKind::name)) {
        if (cursor_.at(TokenKind::garbage)) return;
        return cursor_.error(cursor_.peek().span, "the name of what to set is missing", form);
    }
    statement.name = cursor_.word(cursor_.take());
    if (!parse_index(statement)) return;
    if (statement.index.empty() && cursor_.at(TokenKind::dot)) {
        change.stage = statement.name;
        if (!parse_word_after_dot(statement.name, form) || !parse_index(statement)) return;
    }
    if (!parse_word_after_dot(statement.side, form)) return;
    const ast::Word& name = statement.name;
    if (!cursor_.take_if(TokenKind::assign) && !cursor_.take_if(TokenKind::colon)) {
        if (cursor_.at(TokenKind::garbage)) return;
        return cursor_.error(name.span,
                             fmt::format("'=' is missing after '{}'", shortened(name.text)), form);
    }
    change.statement.values.push_back(
        expressions_.parse("the value of '" + shortened(name.text) + "'"));
    if (statement.side.empty()) {
        give_unit(script_, change.statement.values[0],
                  unit_of_value(script_, change.stage.text, name.text));
    }
    change.statement.span = join(name.span, cursor_.previous().span);
    report_rest("one value", change.statement.values[0],
                cursor_.at(TokenKind::comma) ? "--set may be given again, once for each name"
                                             : form);
    script_.overrides.push_back(std::move(change));
}

}  // namespace cascade
