// Parses the parts of a script outside of blocks: functions, constants, and used files.
#include "lang/syntax/parse_table.h"
#include "lang/syntax/script_parser.h"

#include <fmt/core.h>

namespace cascade {

namespace {

constexpr const char* function_form = "write 'fn name(a, b) = expression'";
constexpr const char* constant_form = "write 'let name = expression'";

}  // namespace

bool ScriptParser::begins_use() const {
    return cursor_.at_name("use") &&
           (cursor_.kind(1) == TokenKind::name || cursor_.kind(1) == TokenKind::text);
}

bool ScriptParser::parse_function_or_use() {
    if (begins_function()) {
        parse_function();
    } else if (begins_use()) {
        parse_use();
    } else {
        return false;
    }
    return true;
}

/// Reports and skips a function or `use` inside a block.
bool ScriptParser::refuse_function_or_use() {
    if (!begins_function() && !begins_use()) return false;
    const Token word = cursor_.take();
    cursor_.error(word.span, fmt::format("{} belongs outside of blocks", cursor_.describe(word)),
                  "write it at the top of the script");
    cursor_.skip_statement();
    return true;
}

/// Parses fn NAME(a, b) = expression, or let NAME = expression.
void ScriptParser::parse_function() {
    ast::FunctionDefinition function;
    function.doc = docs_before();
    function.is_constant = cursor_.at_name("let");
    const char* const kind = function.is_constant ? "constant" : "function";
    const char* const form = function.is_constant ? constant_form : function_form;
    const Token keyword = cursor_.take();
    function.name = cursor_.word(cursor_.take());
    if (!function.is_constant && !parse_parameters(function)) {
        return keep_damaged(std::move(function));
    }
    const std::string name = "'" + shortened(function.name.text) + "'";
    if (cursor_.at(TokenKind::colon) || cursor_.at(TokenKind::equal)) {
        const Token sign = cursor_.take();
        cursor_.error(sign.span, fmt::format("a {} is written with '='", kind), form);
    } else if (!cursor_.take_if(TokenKind::assign)) {
        if (!cursor_.at(TokenKind::garbage)) {
            cursor_.error(function.name.span,
                          fmt::format("'=' is missing after the {} {}", kind, name), form);
        }
        return keep_damaged(std::move(function));
    }
    function.body = parse_after_operator(fmt::format("the value of the {} {}", kind, name), {});
    if (cursor_.at(TokenKind::dots) || cursor_.at(TokenKind::comma)) {
        cursor_.error(cursor_.peek().span,
                      fmt::format("{} has no place in a {}", cursor_.describe(cursor_.peek()),
                                  kind),
                      "its value is one expression");
        cursor_.skip_statement();
    }
    function.span = join(keyword.span, cursor_.previous().span);
    add_docs(function.doc, docs_after(keyword.span.begin));
    script_.functions.push_back(std::move(function));
}

/// Adds a function that has errors, so that calls of the function are not reported as errors, too.
void ScriptParser::keep_damaged(ast::FunctionDefinition function) {
    const auto here = static_cast<ast::ExprId>(script_.expressions.size());
    script_.expressions.push_back({function.name.span, ast::Garbage{}});
    function.parameters.clear();
    function.body = {here, here};
    script_.functions.push_back(std::move(function));
    cursor_.skip_statement();
}

/// Parses the parameters ( [ name { , name } ] ) of a function. If this fails, reports an error and
/// returns false.
bool ScriptParser::parse_parameters(ast::FunctionDefinition& function) {
    const auto refuse = [&](Span span, const std::string& message) {
        if (!cursor_.at(TokenKind::garbage)) cursor_.error(span, message, function_form);
        return false;
    };
    const std::string name = "'" + shortened(function.name.text) + "'";
    if (!cursor_.at(TokenKind::open_round)) {
        return refuse(function.name.span, fmt::format("'(' is missing after {}", name));
    }
    const Token open = cursor_.take();
    cursor_.skip_newlines_in_brackets();
    if (cursor_.take_if(TokenKind::close_round)) return true;
    while (true) {
        if (!cursor_.at(TokenKind::name)) break;
        function.parameters.push_back(cursor_.word(cursor_.take()));
        cursor_.skip_newlines_in_brackets();
        if (cursor_.take_if(TokenKind::close_round)) return true;
        if (!cursor_.take_if(TokenKind::comma)) break;
        cursor_.skip_newlines_in_brackets();
    }
    return refuse(cursor_.at_statement_end() ? open.span : cursor_.peek().span,
                  fmt::format("the parameters of {} must be names with commas between them", name));
}

/// Parses use "file.cascade".
void ScriptParser::parse_use() {
    const Token keyword = cursor_.take();
    const Token file = cursor_.take();
    cursor_.take_docs(keyword.span.begin, cursor_.peek().span.begin);
    if (file.kind != TokenKind::text) {
        cursor_.skip_statement();
        const Span words = join(file.span, cursor_.previous().span);
        const std::string name = shortened(cursor_.text(words));
        const bool has_ending = name.find('.') != name.npos;
        cursor_.error(words, "the name of a file needs quotes",
                      fmt::format("write use \"{}{}\"", name, has_ending ? "" : ".cascade"));
        return add_unknown_names(script_, words);
    }
    const std::string_view text = cursor_.text(file);
    script_.uses.push_back({file.span, std::string(text.substr(1, text.size() - 2))});
    if (cursor_.at_statement_end()) return;
    cursor_.error(cursor_.peek().span, fmt::format("{} has no place after the name of a file",
                                                   cursor_.describe(cursor_.peek())));
    cursor_.skip_statement();
}

}  // namespace cascade
